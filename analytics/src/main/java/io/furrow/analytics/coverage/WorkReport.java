package io.furrow.analytics.coverage;

import java.util.Comparator;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;

/**
 * What a robot reports at an instant.
 *
 * @param fix its position; latitude and longitude are NaN if it reports none
 * @param width working width in meters; NaN if it reports none
 * @param work state of the implement
 */
public record WorkReport(PositionFix fix, double width, Work work) implements HasEventTime {
    /** By time; of two positions of one instant the last in this order counts, those without a position come after them. */
    static final Comparator<WorkReport> SEQUENCE = Comparator.comparing(WorkReport::fix, PositionFix.SEQUENCE)
            .thenComparingDouble(WorkReport::width)
            .thenComparing(WorkReport::work);

    /** The state of an implement. */
    public enum Work {
        /** Not reported. */
        UNKNOWN,
        OFF,
        ON
    }

    @Override
    public long time() {
        return fix.time();
    }

    String key() {
        return fix.key();
    }

    boolean isLocated() {
        return !Double.isNaN(fix.latitude());
    }
}
