package io.furrow.control.context;

import java.util.ArrayList;
import java.util.List;

import io.furrow.control.alarm.Encounter;

/**
 * What analytics found of a mission since it was started.
 *
 * @param mission its name
 * @param start of the run that this is of, epoch ms; null before the first
 * @param collisions how many encounters began
 * @param open ids of those that have not ended, at most {@value #MOST_OPEN}
 * @param minDistance metres, the least of all; null where there was none
 */
record MissionTally(String mission, Long start, long collisions, List<String> open, Double minDistance) {
    private static final int MOST_OPEN = 1000;

    static MissionTally of(String mission, Long start) {
        return new MissionTally(mission, start, 0, List.of(), null);
    }

    /** The same where the encounter says nothing new. */
    MissionTally with(Encounter encounter) {
        boolean began = encounter.phase().equals("started") && !open.contains(encounter.id());
        boolean ended = encounter.phase().equals("ended");
        if (!began && !ended && !encounter.phase().equals("ongoing")) {
            return this;
        }
        List<String> nowOpen = new ArrayList<>(open);
        if (began && nowOpen.size() < MOST_OPEN) {
            nowOpen.add(encounter.id());
        } else if (ended) {
            nowOpen.remove(encounter.id());
        }
        return new MissionTally(
                mission, start, collisions + (began ? 1 : 0), nowOpen, lesser(minDistance, encounter.minDistance()));
    }

    private static Double lesser(Double one, double other) {
        if (Double.isNaN(other)) {
            return one;
        }
        return one == null ? Double.valueOf(other) : Double.valueOf(Math.min(one, other));
    }
}
