package io.furrow.analytics.collision;

import io.furrow.analytics.eventtime.PendingFormat;

/** What waits and is remembered of a device. */
public final class PendingFixesFormat extends PendingFormat<PositionFix, Track> {
    private static final long serialVersionUID = 1L;

    public PendingFixesFormat() {
        super(new PositionFixFormat(), new TrackFormat());
    }
}
