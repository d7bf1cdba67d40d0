package io.furrow.replay.source;

import io.furrow.flink.record.TopicRecord;

/** Topics that take everything. */
final class OnePartition implements ReplayTopics.Writing {
    TopicEnd end = TopicEnd.EMPTY;

    @Override
    public int prepare(String topic) {
        return 1;
    }

    @Override
    public TopicEnd end(String topic) {
        return end;
    }

    @Override
    public TopicRecord writable(TopicRecord record) {
        return record;
    }

    @Override
    public void close() {
        // holds nothing
    }
}
