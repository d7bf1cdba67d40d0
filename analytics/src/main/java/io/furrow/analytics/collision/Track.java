package io.furrow.analytics.collision;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/**
 * Where a device is and which cells know of it.
 *
 * @param last the newest position, which still counts
 * @param cells ids of the cells, the home first
 */
@TypeInfo(TrackFormat.class)
public record Track(PositionFix last, long[] cells) {}
