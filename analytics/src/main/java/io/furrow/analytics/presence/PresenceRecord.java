package io.furrow.analytics.presence;

import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.HexFormat;

import io.furrow.flink.Epochs;
import io.furrow.flink.ResultRecord;
import io.furrow.flink.TopicRecord;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;

/**
 * What the job writes about passages and about positions that it could not count: to the given topic, or to the replay's own of
 * what was found in a replay.
 */
final class PresenceRecord {
    static final String TYPE = "Analytics:Presence";
    private static final String SOURCE = "/analytics/presence";
    private static final String LATE_TYPE = "Analytics:LatePosition";
    private static final int ID_BYTES = 16;

    private PresenceRecord() {}

    /**
     * An entity per device and field, so that the context broker keeps the newest passage and does not grow for ever; key = device id,
     * timestamp = when it was certain.
     */
    static TopicRecord of(Passage passage, String topic) {
        Stay stay = passage.stay();
        PresenceFix fix = stay.fix();
        String id = id(fix.identity(), stay.field());
        EntityBuilder entity = Entity.builder(TYPE + ":" + id, TYPE)
                .text("device", fix.id())
                .text("field", stay.field())
                .text("phase", passage.phase().code())
                .text("cause", stay.cause().code())
                .integer("time", Epochs.original(passage.time()))
                .text("stay", id + "-" + Epochs.text(stay.since()))
                .integer("startTime", Epochs.original(stay.since()))
                .number("Latitude", fix.latitude())
                .number("Longitude", fix.longitude())
                .text("Mission", fix.mission());
        if (passage.phase() == Passage.Phase.LEFT) {
            entity.integer("dwell", stay.left() - stay.since());
        }
        if (!stay.name().isEmpty()) {
            entity.text("fieldName", stay.name());
        }
        if (!stay.domain().isEmpty()) {
            entity.text("Domain", stay.domain());
        }
        String output = Topics.resultOf(fix.topic(), topic);
        return ResultRecord.of(output, fix.id(), entity, fix.scope(), passage.told(), SOURCE);
    }

    /** The position as an entity of the device's id; key = id, timestamp = when the device was there. */
    static TopicRecord late(PresenceFix fix, String topic) {
        EntityBuilder entity = Entity.builder(fix.id(), LATE_TYPE)
                .number("Latitude", fix.latitude())
                .number("Longitude", fix.longitude())
                .integer("Time", Epochs.original(fix.time()))
                .text("Mission", fix.mission());
        return ResultRecord.of(Topics.resultOf(fix.topic(), topic), fix.id(), entity, fix.scope(), fix.time(), SOURCE);
    }

    /** The first 128 bits of a SHA-256 over device and field, in lower-case hexadecimal. */
    private static String id(String device, String field) {
        String text = device.length() + ":" + device + field;
        try {
            byte[] digest = MessageDigest.getInstance("SHA-256").digest(text.getBytes(StandardCharsets.UTF_8));
            return HexFormat.of().formatHex(digest, 0, ID_BYTES);
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("every Java platform has SHA-256", e);
        }
    }
}
