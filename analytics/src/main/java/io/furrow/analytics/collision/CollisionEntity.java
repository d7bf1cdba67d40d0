package io.furrow.analytics.collision;

import io.furrow.analytics.collision.motion.Approach;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

/**
 * An encounter as an entity: {@code Analytics:Collision:<pair>} of type {@code Analytics:Collision}, one per pair, so that
 * the context broker keeps a pair's newest encounter and does not grow for ever.
 */
public final class CollisionEntity {
    public static final String TYPE = "Analytics:Collision";

    private CollisionEntity() {}

    public static Entity of(Encounter encounter) {
        String pair = encounter.pairId();
        EntityBuilder entity = Entity.builder(TYPE + ":" + pair, TYPE)
                .number("distance", encounter.distance())
                .integer("time", encounter.time());
        device(entity, "Device1", encounter.first());
        device(entity, "Device2", encounter.second());
        entity.text("encounter", encounter.id(pair))
                .text("phase", encounter.phase().code())
                .number("minDistance", encounter.minDistance())
                .integer("startTime", encounter.startTime());
        return (encounter.confirms().isEmpty() ? entity : entity.text("confirms", encounter.confirms())).build();
    }

    /** An entity of its own, {@code Analytics:Collision:<pair>:<phase>}: the pair's encounter stays as it is. */
    public static Entity of(Approach approach) {
        String phase = approach.phase().code();
        EntityBuilder entity = Entity.builder(TYPE + ":" + approach.pairId() + ":" + phase, TYPE)
                .number("distance", approach.distance())
                .integer("time", approach.time());
        device(entity, "Device1", approach.first());
        device(entity, "Device2", approach.second());
        return entity.text("encounter", approach.id())
                .text("phase", phase)
                .number("tcpa", approach.tcpa())
                .number("dcpa", approach.dcpa())
                .integer("startTime", approach.startTime())
                .build();
    }

    /** The record's key: both entity ids, the lesser first. */
    public static String key(Encounter encounter) {
        return key(encounter.first(), encounter.second());
    }

    static String key(PositionFix first, PositionFix second) {
        return first.id() + "-" + second.id();
    }

    private static void device(EntityBuilder entity, String name, PositionFix fix) {
        entity.text(name + "_ID", fix.id())
                .number(name + "_latitude", fix.latitude())
                .number(name + "_longitude", fix.longitude())
                .integer(name + "_timestamp", fix.time())
                .text(name + "_Mission", fix.mission());
    }
}
