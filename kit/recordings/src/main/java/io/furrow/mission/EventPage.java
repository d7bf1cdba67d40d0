package io.furrow.mission;

import java.util.List;

/**
 * Consecutive events of a recording.
 *
 * @param events in the order of {@link EventOrder}
 * @param skipped records that hold no event; those without an event time, which have no place in the order, come with the page
 *     that is read from {@link Cursor#START}
 * @param next where the following page begins
 * @param last whether the recording ends here; one that is still being written may continue later
 */
public record EventPage(List<StoredEvent> events, List<SkippedRecords> skipped, Cursor next, boolean last) {}
