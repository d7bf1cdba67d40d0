package io.furrow.analytics.collision.matching;

import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.CellUpdateSerializer;
import io.furrow.analytics.eventtime.KeyStateSerializer;

/** Serializes a grid cell's pending updates and members. */
public final class PendingUpdatesSerializer extends KeyStateSerializer<CellUpdate, Cell> {
    private static final long serialVersionUID = 1L;

    public PendingUpdatesSerializer() {
        super(new CellUpdateSerializer(), new CellSerializer());
    }
}
