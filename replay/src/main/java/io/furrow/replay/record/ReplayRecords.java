package io.furrow.replay.record;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.flink.record.HeaderTexts;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.replay.playback.Played;

/**
 * What is played, as records of the replay's topic: an event as an {@link EventEncoder} has made it ready, with what is known only
 * now; an end is an entity {@code urn:ngsi-ld:Replay:<replay>} with the attribute {@code reason}, for every partition.
 */
public final class ReplayRecords {
    static final String SOURCE = "/replay";
    static final String EVENT = "event";
    static final String PRIME = "prime";

    private static final String TYPE = "Replay";
    private static final String END = "end";

    private ReplayRecords() {}

    /** The record of what was played. */
    public static TopicRecord of(Played played, DesiredReplay replay) {
        if (played.event() == null) {
            return end(played, replay);
        }
        TopicRecord ready = played.event().record();
        return ready.topic().equals(replay.topic())
                ? numbered(ready, played.stamp(), played.sequence(), played.offset())
                : deadLetter(ready, played);
    }

    static TopicRecord numbered(TopicRecord ready, long stamp, long sequence, long offset) {
        HeaderTexts headers = HeaderTexts.of(ready.headers())
                .plus(
                        EventEncoder.header(HeaderNames.REPLAY_SEQUENCE, Long.toString(sequence)),
                        EventEncoder.header(HeaderNames.REPLAY_OFFSET, Long.toString(offset)));
        return new TopicRecord(
                ready.topic(), ready.partition(), ready.offset(), stamp, ready.key(), ready.value(), headers);
    }

    /** Was made of a record with numbers that are as long as can be, unless it had no room for them. */
    private static TopicRecord deadLetter(TopicRecord letter, Played played) {
        if (!letter.headers().containsKey(HeaderNames.REPLAY_SEQUENCE)) {
            return letter.at(played.stamp());
        }
        return letter.at(played.stamp())
                .with(Map.of(
                        HeaderNames.REPLAY_SEQUENCE,
                        Long.toString(played.sequence()),
                        HeaderNames.REPLAY_OFFSET,
                        Long.toString(played.offset())));
    }

    private static TopicRecord end(Played played, DesiredReplay replay) {
        String time = Instant.ofEpochMilli(played.time()).toString();
        Map<String, String> headers = new LinkedHashMap<>();
        headers.put(HeaderNames.CE_ID, EventId.ofReplay(END, replay.replay(), played.epoch()));
        headers.put(HeaderNames.CE_SOURCE, SOURCE);
        headers.put(HeaderNames.CE_TIME, time);
        headers.put(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION);
        headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED);
        headers.put(HeaderNames.SERVICE, FiwareScope.DEFAULT.service());
        headers.put(HeaderNames.SERVICE_PATH, FiwareScope.DEFAULT.servicePath());
        headers.put(HeaderNames.ORIGIN, Origin.REPLAY.code());
        headers.put(HeaderNames.TS_DEVICE, Long.toString(played.time()));
        headers.put(HeaderNames.REPLAY_ID, replay.replay());
        headers.put(HeaderNames.REPLAY_EPOCH, Long.toString(played.epoch()));
        headers.put(HeaderNames.REPLAY_KIND, END);
        headers.put(HeaderNames.REPLAY_TIME, time);
        headers.put(HeaderNames.REPLAY_SEQUENCE, Long.toString(played.sequence()));
        headers.put(HeaderNames.REPLAY_OFFSET, Long.toString(played.offset()));
        String id = "urn:ngsi-ld:Replay:" + replay.replay();
        byte[] value = Entity.builder(id, TYPE)
                .text("reason", played.reason())
                .integer("Time", played.time())
                .text("Mission", replay.mission())
                .toBytes();
        return TopicRecord.of(replay.topic(), played.stamp(), id, value, headers);
    }
}
