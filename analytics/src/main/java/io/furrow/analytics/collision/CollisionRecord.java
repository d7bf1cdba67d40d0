package io.furrow.analytics.collision;

import java.util.HexFormat;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.matching.CellOverflow;
import io.furrow.analytics.collision.motion.Approach;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.ResultRecord;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.result.CollisionResult;
import io.furrow.model.result.ResultTypes;
import io.furrow.model.topic.Topics;

/**
 * Records of encounters, crowded cells and late positions: for the given topic, or for the output topic of the replay that
 * they come from.
 */
final class CollisionRecord {
    private static final String SOURCE = "/analytics/collision";

    private CollisionRecord() {}

    /** In the scope of the device with the lesser id; the entity names that of the other if it differs. */
    static TopicRecord of(Encounter encounter, String topic) {
        return ResultRecord.of(
                Topics.resultOf(encounter.first().topic(), topic),
                CollisionEntity.key(encounter),
                CollisionEntity.of(encounter),
                encounter.first().scope(),
                encounter.time(),
                SOURCE);
    }

    /** One entity per cell; timestamp = the overflow's time. */
    static TopicRecord overflow(CellOverflow overflow, String topic) {
        String cell = HexFormat.of().toHexDigits(overflow.cell());
        EntityBuilder entity = Entity.builder(CollisionResult.OVERFLOW_TYPE + ":" + cell, CollisionResult.OVERFLOW_TYPE)
                .text("cell", cell)
                .number("Latitude", overflow.latitude())
                .number("Longitude", overflow.longitude())
                .integer("time", Epochs.original(overflow.time()))
                .integer("devices", overflow.devices())
                .integer("pairs", overflow.pairs())
                .integer("pairsLeftOut", overflow.pairsLeftOut())
                .integer("nearest", overflow.nearest());
        String output = Topics.resultOf(overflow.witness().topic(), topic);
        return ResultRecord.of(output, entity.id(), entity, overflow.witness().scope(), overflow.time(), SOURCE);
    }

    /** In the scope of the device with the lesser id. */
    static TopicRecord of(Approach approach, String topic) {
        return ResultRecord.of(
                Topics.resultOf(approach.first().topic(), topic),
                CollisionEntity.key(approach.first(), approach.second()),
                CollisionEntity.of(approach),
                approach.first().scope(),
                approach.time(),
                SOURCE);
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
}
