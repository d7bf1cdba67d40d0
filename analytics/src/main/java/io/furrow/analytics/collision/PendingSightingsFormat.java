package io.furrow.analytics.collision;

import io.furrow.analytics.eventtime.PendingFormat;

/** What waits and is remembered of a pair. */
public final class PendingSightingsFormat extends PendingFormat<Sighting, Meeting> {
    private static final long serialVersionUID = 1L;

    public PendingSightingsFormat() {
        super(new SightingFormat(), new MeetingFormat());
    }
}
