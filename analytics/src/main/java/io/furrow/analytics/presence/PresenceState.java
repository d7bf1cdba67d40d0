package io.furrow.analytics.presence;

import java.util.List;

import io.furrow.analytics.position.PositionFix;

/**
 * The state of a device.
 *
 * @param last the newest valid position; null if there is none
 * @param judged up to when changes of fields have been applied, epoch ms
 * @param stays at most one per field
 */
public record PresenceState(PositionFix last, long judged, List<Visit> stays) {
    static final PresenceState NOWHERE = new PresenceState(null, Long.MIN_VALUE, List.of());

    /** Whether the state is empty. */
    boolean isNowhere() {
        return last == null && stays.isEmpty();
    }
}
