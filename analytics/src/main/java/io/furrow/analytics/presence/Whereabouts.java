package io.furrow.analytics.presence;

import java.util.List;

/**
 * What is kept of a device.
 *
 * @param last the newest position, as long as it counts; null where there is none
 * @param judged up to when changes of fields are taken into account, epoch ms
 * @param stays by field, at most one of each
 */
public record Whereabouts(PresenceFix last, long judged, List<Stay> stays) {
    static final Whereabouts NOWHERE = new Whereabouts(null, Long.MIN_VALUE, List.of());

    /** Whether nothing can come of it any more. */
    boolean isNowhere() {
        return last == null && stays.isEmpty();
    }
}
