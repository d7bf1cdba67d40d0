package io.furrow.analytics.collision.grid;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.position.PositionFix;

/**
 * The current position of a device and the cells that contain it.
 *
 * @param last the newest position, which is still valid
 * @param cells ids of the cells, the home first
 */
@TypeInfo(TrackSerializer.class)
public record Track(PositionFix last, long[] cells) {}
