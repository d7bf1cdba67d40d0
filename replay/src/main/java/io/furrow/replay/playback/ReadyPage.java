package io.furrow.replay.playback;

import java.util.List;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;

/**
 * A {@link EventPage} of a recording, made ready to be played.
 *
 * @param events that are played
 * @param read events of the recording, those of other devices among them
 * @param span event time from the first to the last event, ms
 * @param skipped stored documents that hold no event that could be played
 * @param next where the following page begins
 * @param last whether the recording ended here when it was read
 */
public record ReadyPage(List<ReadyEvent> events, int read, long span, long skipped, Cursor next, boolean last) {}
