package io.furrow.analytics.collision.encounter;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.position.PositionFix;

/**
 * The state of a pair while it is close.
 *
 * @param startTime start of the encounter, epoch milliseconds
 * @param minDistance meters, the closest so far
 * @param reported event time of its newest record
 * @param first the newest position of one device, in the order of {@link PositionFix#NAMING}
 * @param second that of the other
 */
@TypeInfo(OpenEncounterSerializer.class)
public record OpenEncounter(long startTime, double minDistance, long reported, PositionFix first, PositionFix second) {}
