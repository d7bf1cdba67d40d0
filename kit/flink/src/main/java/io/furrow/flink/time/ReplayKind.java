package io.furrow.flink.time;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** The purpose of a record. */
public enum ReplayKind {
    /** A reported event, live or replayed. */
    EVENT,
    /** The position of a device at the beginning of an epoch; not a reading. */
    PRIME,
    /** The end of an epoch's records. */
    END;

    /** Live records, and those without a kind, are events; unknown kinds are rejected. */
    public static ReplayKind of(TopicRecord record) throws UnreadableException {
        String kind = Topics.isReplay(record.topic()) ? record.headers().get(HeaderNames.REPLAY_KIND) : null;
        if (kind == null) {
            return EVENT;
        }
        return switch (kind) {
            case "event" -> EVENT;
            case "prime" -> PRIME;
            case "end" -> END;
            default ->
                throw new UnreadableException(
                        Reason.NOT_AN_EVENT, HeaderNames.REPLAY_KIND + " must be event, prime or end");
        };
    }
}
