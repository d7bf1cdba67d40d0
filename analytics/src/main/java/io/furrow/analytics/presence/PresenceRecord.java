package io.furrow.analytics.presence;

import java.nio.charset.StandardCharsets;
import java.util.HexFormat;

import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.ResultRecord;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.result.PresenceResult;
import io.furrow.model.result.ResultTypes;
import io.furrow.model.text.Sha256;
import io.furrow.model.topic.Topics;

/** Records of transitions and late positions: for the given topic, or for the output topic of the replay that they come from. */
final class PresenceRecord {
    private static final String SOURCE = "/analytics/presence";
    private static final int ID_BYTES = 16;

    private PresenceRecord() {}

    /**
     * An entity per device and field, so that the context broker stores the newest transition and does not grow forever; key = device
     * id, timestamp = when it was certain.
     */
    static TopicRecord of(PresenceTransition passage, String topic) {
        Visit stay = passage.stay();
        PositionFix fix = stay.fix();
        String id = id(fix.identity(), stay.field());
        EntityBuilder entity = Entity.builder(PresenceResult.TYPE + ":" + id, PresenceResult.TYPE)
                .text(PresenceResult.DEVICE, fix.id())
                .text(PresenceResult.DEVICE_TYPE, fix.type())
                .text(PresenceResult.FIELD, stay.field())
                .text(PresenceResult.PHASE, passage.phase().code())
                .text("cause", stay.cause().code())
                .integer(PresenceResult.TIME, Epochs.original(passage.time()))
                .text(PresenceResult.STAY, id + "-" + Epochs.text(stay.since()))
                .integer(PresenceResult.START_TIME, Epochs.original(stay.since()))
                .number("Latitude", fix.latitude())
                .number("Longitude", fix.longitude())
                .text("Mission", fix.mission());
        if (passage.phase() == PresenceTransition.Phase.LEFT) {
            entity.integer(PresenceResult.DWELL, stay.left() - stay.since());
        }
        if (!stay.name().isEmpty()) {
            entity.freeText(PresenceResult.FIELD_NAME, stay.name());
        }
        if (!stay.domain().isEmpty()) {
            entity.freeText("Domain", stay.domain());
        }
        String output = Topics.resultOf(fix.topic(), topic);
        return ResultRecord.of(output, fix.id(), entity, fix.scope(), passage.emitted(), SOURCE);
    }

    /** The position as an entity of the device's id; key = id, timestamp = when the device was there. */
    static TopicRecord late(PositionFix fix, String topic) {
        EntityBuilder entity = Entity.builder(fix.id(), ResultTypes.LATE_POSITION)
                .number("Latitude", fix.latitude())
                .number("Longitude", fix.longitude())
                .integer("Time", Epochs.original(fix.time()))
                .text("Mission", fix.mission());
        return ResultRecord.of(Topics.resultOf(fix.topic(), topic), fix.id(), entity, fix.scope(), fix.time(), SOURCE);
    }

    /** The first 128 bits of a SHA-256 over device and field, in lower-case hexadecimal. */
    private static String id(String device, String field) {
        String text = device.length() + ":" + device + field;
        return HexFormat.of().formatHex(Sha256.of(text.getBytes(StandardCharsets.UTF_8)), 0, ID_BYTES);
    }
}
