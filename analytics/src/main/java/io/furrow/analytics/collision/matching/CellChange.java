package io.furrow.analytics.collision.matching;

import java.util.List;

/**
 * What happens to one device of a grid cell at one instant.
 *
 * @param number its place among the changes of the instant
 * @param before the device until then; null if it was not in the cell
 * @param after the device from then on; null if it is not
 * @param partners with whom it had an encounter, less those whose own change comes earlier
 */
record CellChange(int number, CellEntry before, CellEntry after, List<CellEntry> partners) {
    /** Whether a pair with another member is seen by the change of that one, which comes earlier. */
    boolean comesAfterThatOf(CellEntry other) {
        return other.change() != null && other.change().number < number;
    }
}
