package io.furrow.replay.playback;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.Cursor;

/**
 * An event, or a state known before the epoch, that is ready to be played.
 *
 * @param cursor just after the event
 * @param record all that can be known of it before it is played
 */
public record ReadyEvent(Cursor cursor, TopicRecord record) {
    /** Event time, epoch ms. */
    public long time() {
        return cursor.time();
    }

    /** Of the event that was stored. */
    public String id() {
        return cursor.id();
    }
}
