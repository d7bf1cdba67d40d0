package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.Collections;
import java.util.List;

/**
 * Devices on one spot, a fleet beside them, and the job behind both.
 *
 * @param others devices of the fleet, each with a report a second
 * @param lags milliseconds from event time to its result, in each second that counts
 * @param found records of encounters
 * @param overflows records of crowded cells
 * @param secondsCompared seconds of event time whose starts among the fleet were compared with the bare loop's
 * @param secondsDifferent of these, in how many the numbers differ: 0, or something is wrong
 */
public record SustainedCrowd(
        Plan plan,
        int others,
        List<Long> lags,
        long found,
        List<String> overflows,
        int secondsCompared,
        int secondsDifferent) {
    private static final long MAX_LAG = 10_000;

    /**
     * What is measured.
     *
     * @param devices on the spot, each with a report a second
     * @param warmUp before the lag counts
     * @param measured for how long it does
     */
    public record Plan(int devices, Duration warmUp, Duration measured) {}

    /** Whether no result was more than 10 s behind, and all of the fleet was found. */
    public boolean isHeld() {
        return Collections.max(lags) <= MAX_LAG && secondsDifferent == 0 && secondsCompared > 0;
    }

    public void addTo(Figures figures) {
        figures.add(
                "crowd",
                plan.devices(),
                "others",
                others,
                "seconds",
                lags.size(),
                "max lag ms",
                Collections.max(lags),
                "last lag ms",
                lags.get(lags.size() - 1),
                "found/s",
                (double) found / (plan.warmUp().toSeconds() + lags.size()),
                "overflows",
                overflows.size(),
                "differ",
                secondsDifferent + "/" + secondsCompared,
                "held",
                isHeld());
    }
}
