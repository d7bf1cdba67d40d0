package io.furrow.analytics.collision.eager;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.collision.grid.Presence;
import io.furrow.analytics.position.PositionFix;

/**
 * What becomes of a device in one grid cell by what has arrived, without regard to the watermark.
 *
 * @param cell id of the cell
 * @param version rises with every change of the device; at least the event time of the change
 * @param presence what the device is to the cell from this version on
 * @param fix where it is; where {@link Presence#GONE}, its last position in the cell
 */
@TypeInfo(ArrivalSerializer.class)
public record Arrival(long cell, long version, Presence presence, PositionFix fix) {}
