package io.furrow.ingest.image;

import java.util.List;

import io.furrow.flink.TopicRecord;

/**
 * What became of the images of an event.
 *
 * @param record the event with references instead; without images the record itself
 * @param manifest a record on {@code data.images} for each image stored
 * @param deadLetters at most one, the event as it was, where one of its images is broken
 * @param bytes of the images stored
 */
record Moved(TopicRecord record, List<TopicRecord> manifest, List<TopicRecord> deadLetters, long bytes) {
    static Moved unchanged(TopicRecord record) {
        return new Moved(record, List.of(), List.of(), 0);
    }

    int images() {
        return manifest.size();
    }
}
