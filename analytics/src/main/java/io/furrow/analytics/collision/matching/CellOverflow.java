package io.furrow.analytics.collision.matching;

import io.furrow.analytics.position.PositionFix;

/**
 * A grid cell with a crowd, in which not all pairs that are close are followed, or, where none is left out, no more.
 *
 * @param witness a device of the crowd; has its topic and scope
 * @param cell id of the cell
 * @param latitude of its center, degrees
 * @param longitude of its center, degrees
 * @param devices how many are in the cell or so near it that they may meet one that is
 * @param pairs how many are close
 * @param pairsLeftOut how many of them are not followed
 * @param nearest how many of the devices close to it are followed for the device that has the most of them
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
