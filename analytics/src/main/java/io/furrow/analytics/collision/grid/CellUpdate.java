package io.furrow.analytics.collision.grid;

import java.util.Comparator;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;

/**
 * A change of a device in one grid cell.
 *
 * @param cell id of the cell
 * @param time epoch milliseconds
 * @param cellPresence role of the device in the cell from then on
 * @param fix its position from then on; if {@link CellPresence#GONE}, its last in the cell
 */
@TypeInfo(CellUpdateSerializer.class)
public record CellUpdate(long cell, long time, CellPresence cellPresence, PositionFix fix) implements HasEventTime {
    public static final Comparator<CellUpdate> SEQUENCE = Comparator.comparingLong(CellUpdate::time)
            .thenComparing(update -> update.fix().identity());
}
