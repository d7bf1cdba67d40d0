package io.furrow.control.context;

import java.util.List;

import io.furrow.control.alarm.watch.FieldWindow;

/**
 * Result of the newest window of a field.
 *
 * @param average null if there was nothing to average
 * @param suspects by type and id
 * @param windowEnd epoch ms
 * @param domain domain that the field's record names; null if none
 * @param known when it was received, epoch ms
 */
record FieldState(String field, Double average, List<String> suspects, long windowEnd, String domain, long known) {
    static FieldState of(FieldWindow window, long now) {
        List<String> suspects =
                window.suspects().stream().map(FieldWindow.Suspect::key).toList();
        return new FieldState(window.field(), window.average(), suspects, window.windowEnd(), window.domain(), now);
    }
}
