package io.furrow.analytics.collision;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.motion.Approach;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.result.CollisionResult;

/**
 * Describes an encounter as an entity {@code Analytics:Collision:<pair>} of type {@code Analytics:Collision}: one per
 * pair, so that the context broker stores a pair's newest encounter and does not grow forever.
 */
public final class CollisionEntity {
    private CollisionEntity() {}

    public static EntityBuilder of(Encounter encounter) {
        String pair = encounter.pairId();
        EntityBuilder entity = Entity.builder(CollisionResult.TYPE + ":" + pair, CollisionResult.TYPE)
                .number(CollisionResult.DISTANCE, encounter.distance())
                .integer(CollisionResult.TIME, Epochs.original(encounter.time()));
        devices(entity, encounter.first(), encounter.second());
        return entity.text(CollisionResult.ENCOUNTER, encounter.id(pair))
                .text(CollisionResult.PHASE, encounter.phase().code())
                .number(CollisionResult.MIN_DISTANCE, encounter.minDistance())
                .integer(CollisionResult.START_TIME, Epochs.original(encounter.startTime()));
    }

    /** A separate entity, {@code Analytics:Collision:<pair>:<phase>}, so that the pair's encounter is not overwritten. */
    public static EntityBuilder of(Approach approach) {
        String phase = approach.phase().code();
        EntityBuilder entity = Entity.builder(
                        CollisionResult.TYPE + ":" + approach.pairId() + ":" + phase, CollisionResult.TYPE)
                .number(CollisionResult.DISTANCE, approach.distance())
                .integer(CollisionResult.TIME, Epochs.original(approach.time()));
        devices(entity, approach.first(), approach.second());
        return entity.text(CollisionResult.ENCOUNTER, approach.id())
                .text(CollisionResult.PHASE, phase)
                .number(CollisionResult.TCPA, approach.tcpa())
                .number(CollisionResult.DCPA, approach.dcpa())
                .integer(CollisionResult.START_TIME, Epochs.original(approach.startTime()));
    }

    /** The record's key: both entity ids, the lesser first. */
    static String key(Encounter encounter) {
        return key(encounter.first(), encounter.second());
    }

    static String key(PositionFix first, PositionFix second) {
        return first.id() + "-" + second.id();
    }

    /** The record has the scope of the first device; that of the second is added if it differs. */
    private static void devices(EntityBuilder entity, PositionFix first, PositionFix second) {
        device(entity, CollisionResult.FIRST, first);
        device(entity, CollisionResult.SECOND, second);
        FiwareScope scope = second.scope();
        if (!scope.equals(first.scope())) {
            entity.text(CollisionResult.SECOND.service(), scope.service())
                    .text(CollisionResult.SECOND.servicePath(), scope.servicePath());
        }
    }

    private static void device(EntityBuilder entity, CollisionResult.Member names, PositionFix fix) {
        entity.text(names.id(), fix.id())
                .number(names.latitude(), fix.latitude())
                .number(names.longitude(), fix.longitude())
                .integer(names.timestamp(), Epochs.original(fix.time()))
                .text(names.mission(), fix.mission())
                .text(names.type(), fix.type());
    }
}
