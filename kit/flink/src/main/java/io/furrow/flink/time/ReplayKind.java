package io.furrow.flink.time;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** What a record is there for. */
public enum ReplayKind {
    /** Something that was reported, live or then. */
    EVENT,
    /** Where a device is at the point at which an epoch begins: a position, and no reading. */
    PRIME,
    /** Nothing more comes in this epoch. */
    END;

    /** Records of live topics, and those that do not say, are events; any other word than these three is refused. */
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
