package io.furrow.ingest.image;

import java.util.List;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Reason;

/**
 * The result of moving the images of an event.
 *
 * @param record the event with references; without images the record itself
 * @param manifest a record on {@code data.images} for each stored image
 * @param deadLetters at most one, the unchanged event, if one of its images is broken
 * @param broken the reason of the dead letter; null if there is none
 * @param bytes of the stored images
 */
record MoveResult(
        TopicRecord record, List<TopicRecord> manifest, List<TopicRecord> deadLetters, Reason broken, long bytes) {
    /** Only the record. */
    static MoveResult unannounced(TopicRecord record) {
        return new MoveResult(record, List.of(), List.of(), null, 0);
    }

    int images() {
        return manifest.size();
    }
}
