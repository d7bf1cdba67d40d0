package io.furrow.analytics.clock;

import io.furrow.model.event.FiwareScope;

/**
 * A finding about the clock of a device.
 *
 * @param topic the topic that reports the device
 * @param identity begins with tenant and service path
 * @param id the entity id
 * @param type of the entity; empty if unknown
 * @param mission of the device; empty if unknown
 * @param millis {@link Kind#BEHIND}: lateness of the newest position; {@link Kind#DELAYED}: delay of the newest record, from event
 *     time to receipt; {@link Kind#OFFSET}: the offset added to the device's times
 * @param positions {@link Kind#BEHIND}: number of late positions in a row; {@link Kind#DELAYED}: number of records
 * @param interval milliseconds after which the next report is expected; 0 for {@link Kind#OFFSET}
 * @param time event time of the report, epoch ms
 */
public record ClockReport(
        Kind kind,
        String topic,
        String identity,
        String id,
        String type,
        String mission,
        long millis,
        int positions,
        long interval,
        long time) {
    /** The kind of finding. */
    public enum Kind {
        /** The device's positions are late. */
        BEHIND,
        /** The device's records arrive long after their time. */
        DELAYED,
        /** The device's times are corrected by a new offset from now on. */
        OFFSET
    }

    static ClockReport behind(LaggingPosition position, LagStreak streak) {
        String type = FiwareScope.typeOf(position.identity(), position.id());
        return of(Kind.BEHIND, position, type, position.mission(), streak);
    }

    static ClockReport delayed(LaggingPosition record, String type, String mission, LagStreak streak) {
        return of(Kind.DELAYED, record, type, mission, streak);
    }

    private static ClockReport of(Kind kind, LaggingPosition position, String type, String mission, LagStreak streak) {
        return new ClockReport(
                kind,
                position.topic(),
                position.identity(),
                position.id(),
                type,
                mission,
                position.reached() - position.time(),
                streak.positions(),
                streak.interval(),
                position.reached());
    }

    /** The tenant and service path from the identity. */
    FiwareScope scope() {
        return FiwareScope.ofIdentity(identity);
    }
}
