package io.furrow.control.alarm.watch;

import java.util.HashMap;
import java.util.Map;

/**
 * Number of consecutive windows in which each suspect sensor of a field has been excluded.
 *
 * @param field tenant, service path and id
 * @param windowEnd end of the newest window, epoch ms
 * @param windows number of windows by type and id of the sensor's entity; contains only the suspects of the newest window
 */
record SuspectStreaks(String field, long windowEnd, Map<String, Integer> windows) {
    SuspectStreaks {
        windows = Map.copyOf(windows);
    }

    /** Returns the streaks after another window. A window that is not newer, or that has too few devices, changes nothing. */
    SuspectStreaks after(FieldWindow window) {
        if (window.windowEnd() <= windowEnd || !window.verified()) {
            return this;
        }
        Map<String, Integer> now = new HashMap<>();
        window.suspects().forEach(suspect -> now.put(suspect.key(), of(suspect) + 1));
        return new SuspectStreaks(field, window.windowEnd(), now);
    }

    /** Returns the streak of a suspect; one of results without types is stored by id alone. */
    int of(FieldWindow.Suspect suspect) {
        return windows.getOrDefault(suspect.key(), windows.getOrDefault(suspect.id(), 0));
    }
}
