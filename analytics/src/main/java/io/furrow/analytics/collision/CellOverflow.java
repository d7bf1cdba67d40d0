package io.furrow.analytics.collision;

/**
 * A grid cell in which more pairs are close than are followed, or, where none is left out, no more.
 *
 * @param witness a device of a pair that was seen at that instant; tells topic and scope
 * @param cell id of the cell
 * @param latitude of its centre, degrees
 * @param longitude of its centre, degrees
 * @param devices how many are in the cell or so near it that they may meet one that is
 * @param pairs how many are close
 * @param pairsLeftOut how many of them are not followed
 * @param time epoch milliseconds
 */
public record CellOverflow(
        PositionFix witness,
        long cell,
        double latitude,
        double longitude,
        int devices,
        int pairs,
        int pairsLeftOut,
        long time) {}
