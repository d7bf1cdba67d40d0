package io.furrow.connect.sink;

import java.util.List;

/**
 * What one delivery asks of the context broker: first the deletions, then the updates; no two updates are of one entity.
 *
 * @param partial deletions that some attributes are newer than: they take the other attributes away
 * @param stale how many changes say nothing that is newer than what is known
 * @param coalesced how many changes are part of another's update, or gave way to a deletion
 */
record Plan(List<Change> deletions, List<Change> partial, List<Update> updates, int stale, int coalesced) {}
