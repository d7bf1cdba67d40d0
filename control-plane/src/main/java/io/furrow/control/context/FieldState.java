package io.furrow.control.context;

import java.util.List;

import io.furrow.control.alarm.FieldWindow;

/**
 * What the newest window of a field found.
 *
 * @param average null where there was nothing to average
 * @param windowEnd epoch ms
 * @param domain that the field says it belongs to; null where it says none
 * @param known when that became known, epoch ms
 */
record FieldState(String field, Double average, List<String> suspects, long windowEnd, String domain, long known) {
    static FieldState of(FieldWindow window, long now) {
        return new FieldState(
                window.field(), window.average(), window.suspects(), window.windowEnd(), window.domain(), now);
    }
}
