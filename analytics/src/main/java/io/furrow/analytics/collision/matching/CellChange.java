package io.furrow.analytics.collision.matching;

import java.util.List;

/**
 * The change of one device of a grid cell at one instant.
 *
 * @param number its index among the changes of the instant
 * @param before the device until then; null if it was not in the cell
 * @param after the device from then on; null if it left
 * @param partners devices with which it had an encounter, except those whose own change comes earlier
 */
record CellChange(int number, CellEntry before, CellEntry after, List<CellEntry> partners) {
    /** Whether the other member changes earlier at this instant, and so reports the pair. */
    boolean comesAfterThatOf(CellEntry other) {
        return other.change() != null && other.change().number < number;
    }
}
