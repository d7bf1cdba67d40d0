package io.furrow.analytics.clock;

import io.furrow.model.event.FiwareScope;

/**
 * What was found out about the clock of a device.
 *
 * @param topic the topic that reports the device
 * @param identity begins with tenant and service path
 * @param id the entity id
 * @param type of the entity; empty if that is not known
 * @param mission the mission it works for; empty if that is not known
 * @param millis of {@link Kind#BEHIND} how much too late the newest position came, of {@link Kind#DELAYED} how long after its time the
 *     newest record was received, of {@link Kind#OFFSET} what is added to its times
 * @param positions of {@link Kind#BEHIND} how many came too late in a row, of {@link Kind#DELAYED} how many records
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
        long time) {
    /** What it reports. */
    public enum Kind {
        /** The device's positions come too late to count. */
        BEHIND,
        /** The device's records come long after their time. */
        DELAYED,
        /** The device's times are corrected by another offset from now on. */
        OFFSET
    }

    static ClockReport behind(LaggingPosition position, int positions) {
        String type = FiwareScope.typeOf(position.identity(), position.id());
        return of(Kind.BEHIND, position, type, position.mission(), positions);
    }

    static ClockReport delayed(LaggingPosition record, String type, String mission, int records) {
        return of(Kind.DELAYED, record, type, mission, records);
    }

    private static ClockReport of(Kind kind, LaggingPosition position, String type, String mission, int positions) {
        return new ClockReport(
                kind,
                position.topic(),
                position.identity(),
                position.id(),
                type,
                mission,
                position.reached() - position.time(),
                positions,
                position.reached());
    }

    /** The tenant and service path that the identity begins with. */
    FiwareScope scope() {
        return FiwareScope.ofIdentity(identity);
    }
}
