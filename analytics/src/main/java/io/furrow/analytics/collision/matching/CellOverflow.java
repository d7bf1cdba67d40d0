package io.furrow.analytics.collision.matching;

import io.furrow.analytics.position.PositionFix;

/**
 * A crowded grid cell in which not all close pairs are followed, or, if no pair is left out, the end of its crowd.
 *
 * @param witness a device of the crowd; has its topic and scope
 * @param cell id of the cell
 * @param latitude of its center, degrees
 * @param longitude of its center, degrees
 * @param devices number of devices in the cell or near enough to meet one that is
 * @param pairs number of close pairs
 * @param pairsLeftOut number of close pairs that are not followed
 * @param nearest the greatest number of close devices followed for any one device
 * @param time epoch milliseconds
 */
public record CellOverflow(
        PositionFix witness,
        long cell,
        double latitude,
        double longitude,
        int devices,
        long pairs,
        long pairsLeftOut,
        int nearest,
        long time) {}
