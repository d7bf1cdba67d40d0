package io.furrow.analytics.presence;

import java.util.List;

import io.furrow.analytics.position.PositionFix;

/**
 * What is kept of a device.
 *
 * @param last the newest position, as long as it counts; null if there is none
 * @param judged up to when changes of fields are taken into account, epoch ms
 * @param stays by field, at most one of each
 */
public record PresenceState(PositionFix last, long judged, List<Visit> stays) {
    static final PresenceState NOWHERE = new PresenceState(null, Long.MIN_VALUE, List.of());

    /** Whether nothing can come of it any more. */
    boolean isNowhere() {
        return last == null && stays.isEmpty();
    }
}
