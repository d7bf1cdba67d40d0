package io.furrow.replay.record;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.flink.record.TextHeaders;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.replay.playback.PlaybackRecord;

/**
 * Composes the records of a replay's topic: an event as {@link EventEncoder} prepared it, plus the headers that depend
 * on the time of playing; an end is an entity {@code urn:ngsi-ld:Replay:<replay>} with the attribute {@code reason},
 * for every partition.
 */
public final class ReplayRecords {
    static final String SOURCE = "/replay";
    static final String EVENT = "event";
    static final String PRIME = "prime";

    private static final String TYPE = "Replay";
    private static final String END = "end";

    private ReplayRecords() {}

    public static TopicRecord of(PlaybackRecord playbackRecord, DesiredReplay replay) {
        if (playbackRecord.event() == null) {
            return end(playbackRecord, replay);
        }
        TopicRecord ready = playbackRecord.event().record();
        return ready.topic().equals(replay.topic())
                ? numbered(ready, playbackRecord.stamp(), playbackRecord.sequence(), playbackRecord.offset())
                : deadLetter(ready, playbackRecord);
    }

    static TopicRecord numbered(TopicRecord ready, long stamp, long sequence, long offset) {
        TextHeaders headers = TextHeaders.of(ready.headers())
                .plus(
                        EventEncoder.header(HeaderNames.REPLAY_SEQUENCE, Long.toString(sequence)),
                        EventEncoder.header(HeaderNames.REPLAY_OFFSET, Long.toString(offset)));
        return new TopicRecord(
                ready.topic(), ready.partition(), ready.offset(), stamp, ready.key(), ready.value(), headers);
    }

    /** Replaces the placeholder numbers of a dead letter, unless the headers were too large to contain them. */
    private static TopicRecord deadLetter(TopicRecord deadRecord, PlaybackRecord playbackRecord) {
        if (!deadRecord.headers().containsKey(HeaderNames.REPLAY_SEQUENCE)) {
            return deadRecord.at(playbackRecord.stamp());
        }
        return deadRecord
                .at(playbackRecord.stamp())
                .with(Map.of(
                        HeaderNames.REPLAY_SEQUENCE,
                        Long.toString(playbackRecord.sequence()),
                        HeaderNames.REPLAY_OFFSET,
                        Long.toString(playbackRecord.offset())));
    }

    private static TopicRecord end(PlaybackRecord playbackRecord, DesiredReplay replay) {
        String time = Instant.ofEpochMilli(playbackRecord.time()).toString();
        Map<String, String> headers = new LinkedHashMap<>();
        headers.put(HeaderNames.CE_ID, EventId.ofReplay(END, replay.replay(), playbackRecord.epoch()));
        headers.put(HeaderNames.CE_SOURCE, SOURCE);
        headers.put(HeaderNames.CE_TIME, time);
        headers.put(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION);
        headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED);
        headers.put(HeaderNames.SERVICE, FiwareScope.DEFAULT.service());
        headers.put(HeaderNames.SERVICE_PATH, FiwareScope.DEFAULT.servicePath());
        headers.put(HeaderNames.ORIGIN, Origin.REPLAY.code());
        headers.put(HeaderNames.TS_DEVICE, Long.toString(playbackRecord.time()));
        headers.put(HeaderNames.REPLAY_ID, replay.replay());
        headers.put(HeaderNames.REPLAY_EPOCH, Long.toString(playbackRecord.epoch()));
        headers.put(HeaderNames.REPLAY_KIND, END);
        headers.put(HeaderNames.REPLAY_TIME, time);
        headers.put(HeaderNames.REPLAY_SEQUENCE, Long.toString(playbackRecord.sequence()));
        headers.put(HeaderNames.REPLAY_OFFSET, Long.toString(playbackRecord.offset()));
        String id = "urn:ngsi-ld:Replay:" + replay.replay();
        byte[] value = Entity.builder(id, TYPE)
                .text("reason", playbackRecord.reason())
                .integer("Time", playbackRecord.time())
                .text("Mission", replay.mission())
                .toBytes();
        return TopicRecord.of(replay.topic(), playbackRecord.stamp(), id, value, headers);
    }
}
