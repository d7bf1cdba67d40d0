package io.furrow.replay.playback;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.Cursor;

/**
 * An event, or a state from before the epoch, that is ready to be played.
 *
 * @param cursor position after the event
 * @param record the record without the members that depend on the time of playing
 */
public record ReadyEvent(Cursor cursor, TopicRecord record) {
    /** Returns the event time, epoch ms. */
    public long time() {
        return cursor.time();
    }

    /** Returns the id of the stored event. */
    public String id() {
        return cursor.id();
    }
}
