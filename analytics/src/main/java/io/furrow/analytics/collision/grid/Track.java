package io.furrow.analytics.collision.grid;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.position.PositionFix;

/**
 * Where a device is and which cells know of it.
 *
 * @param last the newest position, which still counts
 * @param cells ids of the cells, the home first
 */
@TypeInfo(TrackSerializer.class)
public record Track(PositionFix last, long[] cells) {}
