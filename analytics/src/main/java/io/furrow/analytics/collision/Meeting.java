package io.furrow.analytics.collision;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/**
 * What is remembered of a pair while it is close.
 *
 * @param startTime since when, epoch milliseconds
 * @param minDistance metres, the closest so far
 * @param reported event time of the newest record about it
 */
@TypeInfo(MeetingFormat.class)
public record Meeting(long startTime, double minDistance, long reported) {}
