package io.furrow.analytics.collision;

import io.furrow.flink.ResultRecord;
import io.furrow.flink.TopicRecord;
import io.furrow.model.ngsi.Entity;

/** What the job writes about encounters and about positions that it could not count. */
final class CollisionRecord {
    private static final String SOURCE = "/analytics/collision";
    private static final String LATE_TYPE = "Analytics:LatePosition";

    private CollisionRecord() {}

    /** In the scope of the device with the lesser id; both devices nearly always share one. */
    static TopicRecord of(Encounter encounter, String topic) {
        return ResultRecord.of(
                topic,
                CollisionEntity.key(encounter),
                CollisionEntity.of(encounter),
                encounter.first().scope(),
                encounter.time(),
                SOURCE);
    }

    /** The position as an entity of the device's id; key = id, timestamp = when the device was there. */
    static TopicRecord late(PositionFix fix, String topic) {
        Entity entity = Entity.builder(fix.id(), LATE_TYPE)
                .number("Latitude", fix.latitude())
                .number("Longitude", fix.longitude())
                .integer("Time", fix.time())
                .text("Mission", fix.mission())
                .build();
        return ResultRecord.of(topic, fix.id(), entity, fix.scope(), fix.time(), SOURCE);
    }
}
