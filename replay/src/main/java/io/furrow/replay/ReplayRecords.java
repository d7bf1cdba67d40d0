package io.furrow.replay;

import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.replay.WantedReplay;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.replay.playback.Played;

/**
 * What is played, as records of the replay's topic. An event is the record that it was, with the headers of a replay; an end is an
 * entity {@code urn:ngsi-ld:Replay:<replay>} with the attribute {@code reason}, for every partition.
 */
public final class ReplayRecords {
    private static final String SOURCE = "/replay";
    private static final String TYPE = "Replay";
    private static final String END = "end";

    private ReplayRecords() {}

    /** The record of what was played. */
    public static TopicRecord of(Played played, WantedReplay replay) {
        Map<String, String> headers = new LinkedHashMap<>();
        StoredEvent event = played.event();
        if (event != null) {
            headers.putAll(event.headers());
        }
        Instant time = Instant.ofEpochMilli(event == null ? played.time() : event.time());
        headers.put(
                HeaderNames.CE_ID, EventId.ofReplay(event == null ? END : event.id(), replay.replay(), played.epoch()));
        headers.putIfAbsent(HeaderNames.CE_SOURCE, SOURCE);
        headers.put(HeaderNames.CE_TIME, time.toString());
        headers.put(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION);
        boolean deleted = event != null && event.entity() == null;
        headers.putIfAbsent(HeaderNames.CE_TYPE, deleted ? HeaderNames.TYPE_DELETED : HeaderNames.TYPE_CHANGED);
        headers.putIfAbsent(HeaderNames.SERVICE, FiwareScope.DEFAULT.service());
        headers.putIfAbsent(HeaderNames.SERVICE_PATH, FiwareScope.DEFAULT.servicePath());
        headers.put(HeaderNames.ORIGIN, Origin.REPLAY.code());
        headers.put(HeaderNames.TS_DEVICE, Long.toString(time.toEpochMilli()));
        headers.put(HeaderNames.REPLAY_ID, replay.replay());
        headers.put(HeaderNames.REPLAY_EPOCH, Long.toString(played.epoch()));
        headers.put(HeaderNames.REPLAY_KIND, kind(played.kind()));
        headers.put(HeaderNames.REPLAY_TIME, Instant.ofEpochMilli(played.time()).toString());
        headers.put(HeaderNames.REPLAY_SEQUENCE, Long.toString(played.sequence()));
        headers.put(HeaderNames.REPLAY_OFFSET, Long.toString(played.offset()));
        if (event == null) {
            byte[] end = end(played, replay);
            return TopicRecord.of(replay.topic(), played.stamp(), entityId(replay), end, headers);
        }
        headers.put(HeaderNames.REPLAY_CE_ID, event.id());
        byte[] value = deleted ? null : NgsiJson.write(event.entity());
        return TopicRecord.of(replay.topic(), played.stamp(), event.entityId(), value, headers);
    }

    private static String kind(Played.Kind kind) {
        return switch (kind) {
            case EVENT -> "event";
            case PRIME -> "prime";
            case END -> END;
        };
    }

    private static String entityId(WantedReplay replay) {
        return "urn:ngsi-ld:Replay:" + replay.replay();
    }

    private static byte[] end(Played played, WantedReplay replay) {
        return Entity.builder(entityId(replay), TYPE)
                .text("reason", played.reason())
                .integer("Time", played.time())
                .text("Mission", replay.mission())
                .toBytes();
    }
}
