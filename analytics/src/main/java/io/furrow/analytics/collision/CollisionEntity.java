package io.furrow.analytics.collision;

import io.furrow.analytics.collision.motion.Approach;
import io.furrow.flink.Epochs;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

/**
 * An encounter as an entity: {@code Analytics:Collision:<pair>} of type {@code Analytics:Collision}, one per pair, so that
 * the context broker keeps a pair's newest encounter and does not grow for ever.
 */
public final class CollisionEntity {
    public static final String TYPE = "Analytics:Collision";

    private CollisionEntity() {}

    public static EntityBuilder of(Encounter encounter) {
        String pair = encounter.pairId();
        EntityBuilder entity = Entity.builder(TYPE + ":" + pair, TYPE)
                .number("distance", encounter.distance())
                .integer("time", Epochs.original(encounter.time()));
        device(entity, Names.FIRST, encounter.first());
        device(entity, Names.SECOND, encounter.second());
        entity.text("encounter", encounter.id(pair))
                .text("phase", encounter.phase().code())
                .number("minDistance", encounter.minDistance())
                .integer("startTime", Epochs.original(encounter.startTime()));
        return encounter.confirms().isEmpty() ? entity : entity.text("confirms", encounter.confirms());
    }

    /** An entity of its own, {@code Analytics:Collision:<pair>:<phase>}: the pair's encounter stays as it is. */
    public static EntityBuilder of(Approach approach) {
        String phase = approach.phase().code();
        EntityBuilder entity = Entity.builder(TYPE + ":" + approach.pairId() + ":" + phase, TYPE)
                .number("distance", approach.distance())
                .integer("time", Epochs.original(approach.time()));
        device(entity, Names.FIRST, approach.first());
        device(entity, Names.SECOND, approach.second());
        return entity.text("encounter", approach.id())
                .text("phase", phase)
                .number("tcpa", approach.tcpa())
                .number("dcpa", approach.dcpa())
                .integer("startTime", Epochs.original(approach.startTime()));
    }

    /** The record's key: both entity ids, the lesser first. */
    public static String key(Encounter encounter) {
        return key(encounter.first(), encounter.second());
    }

    static String key(PositionFix first, PositionFix second) {
        return first.id() + "-" + second.id();
    }

    /** The names of a device's attributes; made once, because of all results these are told most. */
    private record Names(String id, String latitude, String longitude, String timestamp, String mission) {
        static final Names FIRST = of("Device1");
        static final Names SECOND = of("Device2");

        private static Names of(String device) {
            return new Names(
                    device + "_ID",
                    device + "_latitude",
                    device + "_longitude",
                    device + "_timestamp",
                    device + "_Mission");
        }
    }

    private static void device(EntityBuilder entity, Names names, PositionFix fix) {
        entity.text(names.id, fix.id())
                .number(names.latitude, fix.latitude())
                .number(names.longitude, fix.longitude())
                .integer(names.timestamp, Epochs.original(fix.time()))
                .text(names.mission, fix.mission());
    }
}
