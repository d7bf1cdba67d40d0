package io.furrow.control.context;

import java.util.ArrayList;
import java.util.List;

import io.furrow.control.alarm.watch.EncounterReport;

/**
 * Results of analytics for a mission since it was started.
 *
 * @param mission its name
 * @param start start of the run, epoch ms; null before the first
 * @param collisions number of encounters that began
 * @param open ids of encounters that have not ended, at most {@value #MAX_OPEN}
 * @param minDistance meters, the minimum of all; null if none
 */
record MissionCounts(String mission, Long start, long collisions, List<String> open, Double minDistance) {
    private static final int MAX_OPEN = 1000;

    static MissionCounts of(String mission, Long start) {
        return new MissionCounts(mission, start, 0, List.of(), null);
    }

    /** Returns the counts after an encounter's record, or the same instance if its phase does not count. */
    MissionCounts with(EncounterReport encounter) {
        boolean began = encounter.phase().equals("started") && !open.contains(encounter.id());
        boolean ended = encounter.phase().equals("ended");
        if (!began && !ended && !encounter.phase().equals("ongoing")) {
            return this;
        }
        List<String> nowOpen = new ArrayList<>(open);
        if (began && nowOpen.size() < MAX_OPEN) {
            nowOpen.add(encounter.id());
        } else if (ended) {
            nowOpen.remove(encounter.id());
        }
        return new MissionCounts(
                mission, start, collisions + (began ? 1 : 0), nowOpen, lesser(minDistance, encounter.minDistance()));
    }

    private static Double lesser(Double one, double other) {
        if (Double.isNaN(other)) {
            return one;
        }
        return one == null ? Double.valueOf(other) : Double.valueOf(Math.min(one, other));
    }
}
