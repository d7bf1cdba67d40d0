package io.furrow.replay.playback;

import java.util.List;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;

/**
 * A {@link EventPage} of a recording that is ready to be played.
 *
 * @param events the replay's events, without those of other devices
 * @param read number of events of the recording, including those of other devices
 * @param span event time from the first to the last event, ms
 * @param skipped stored documents without a valid event
 * @param next beginning of the following page
 * @param last whether the recording ended here when it was read
 */
public record ReadyPage(List<ReadyEvent> events, int read, long span, long skipped, Cursor next, boolean last) {}
