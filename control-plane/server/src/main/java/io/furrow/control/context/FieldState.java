package io.furrow.control.context;

import java.util.List;

import io.furrow.control.alarm.watch.FieldWindow;
import io.furrow.model.event.FiwareScope;

/**
 * Result of the newest window of a field, of the devices of one tenant and service path.
 *
 * @param average null if there was nothing to average
 * @param suspects by tenant, service path, type and id
 * @param windowEnd epoch ms
 * @param domain domain that the field's record names; null if none
 * @param known when it was received, epoch ms
 * @param identity of the devices' tenant and service path, and the field; null in a state of an older version
 */
record FieldState(
        String field,
        Double average,
        List<String> suspects,
        long windowEnd,
        String domain,
        long known,
        String identity) {
    /** @param scope of the devices */
    static FieldState of(FieldWindow window, FiwareScope scope, long now) {
        List<String> suspects = window.suspects().stream()
                .map(suspect -> scope.identity(suspect.type(), suspect.id()))
                .toList();
        return new FieldState(
                window.field(),
                window.average(),
                suspects,
                window.windowEnd(),
                window.domain(),
                now,
                scope.identity(window.field()));
    }

    String key() {
        return identity == null ? field : identity;
    }
}
