package io.furrow.replay.source;

import io.furrow.flink.record.TopicRecord;

/** Topics that take everything. */
final class OnePartition implements ReplayTopics.Writing {
    long newestEpoch = NewestEpoch.NONE;

    @Override
    public int prepare(String topic) {
        return 1;
    }

    @Override
    public long newestEpoch(String topic) {
        return newestEpoch;
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
