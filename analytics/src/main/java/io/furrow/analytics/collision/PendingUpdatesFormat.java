package io.furrow.analytics.collision;

import io.furrow.analytics.eventtime.PendingFormat;

/** What waits for a grid cell and is remembered of it. */
public final class PendingUpdatesFormat extends PendingFormat<CellUpdate, Cell> {
    private static final long serialVersionUID = 1L;

    public PendingUpdatesFormat() {
        super(new CellUpdateFormat(), new CellFormat());
    }
}
