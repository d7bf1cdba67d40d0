package io.furrow.analytics.collision.encounter;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/**
 * What is remembered of a pair while it is close.
 *
 * @param startTime since when, epoch milliseconds
 * @param minDistance meters, the closest so far
 * @param reported event time of the newest record about it
 */
@TypeInfo(OpenEncounterSerializer.class)
public record OpenEncounter(long startTime, double minDistance, long reported) {}
