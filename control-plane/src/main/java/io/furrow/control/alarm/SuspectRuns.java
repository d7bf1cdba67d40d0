package io.furrow.control.alarm;

import java.util.HashMap;
import java.util.Map;

/**
 * In how many windows in a row the suspects of a field have been set aside.
 *
 * @param field tenant, service path and id
 * @param windowEnd of the newest window, epoch ms
 * @param windows by the id of the sensor's entity; only those that the newest window names
 */
record SuspectRuns(String field, long windowEnd, Map<String, Integer> windows) {
    SuspectRuns {
        windows = Map.copyOf(windows);
    }

    /** After another window; a window that is not newer changes nothing, nor does one with too few devices to tell. */
    SuspectRuns after(FieldWindow window) {
        if (window.windowEnd() <= windowEnd || !window.verified()) {
            return this;
        }
        Map<String, Integer> now = new HashMap<>();
        window.suspects().forEach(suspect -> now.put(suspect, of(suspect) + 1));
        return new SuspectRuns(field, window.windowEnd(), now);
    }

    int of(String suspect) {
        return windows.getOrDefault(suspect, 0);
    }
}
