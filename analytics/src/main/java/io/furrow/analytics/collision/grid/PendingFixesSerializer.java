package io.furrow.analytics.collision.grid;

import io.furrow.analytics.eventtime.KeyStateSerializer;
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.position.PositionFixSerializer;

/** Serializes a device's pending positions and track. */
public final class PendingFixesSerializer extends KeyStateSerializer<PositionFix, Track> {
    private static final long serialVersionUID = 1L;

    public PendingFixesSerializer() {
        super(new PositionFixSerializer(), new TrackSerializer());
    }
}
