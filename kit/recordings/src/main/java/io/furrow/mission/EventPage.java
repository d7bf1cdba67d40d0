package io.furrow.mission;

import java.util.List;

/**
 * Consecutive events of a recording.
 *
 * @param events in the order of {@link EventOrder}
 * @param skipped records without a valid event; those without an event time, which have no place in the order, are
 * reported with the page from {@link Cursor#START}
 * @param next beginning of the following page
 * @param last whether the recording ends here; one that is still being written may continue later
 */
public record EventPage(List<StoredEvent> events, List<SkippedRecords> skipped, Cursor next, boolean last) {}
