package io.furrow.replay.source;

import java.io.IOException;
import java.util.Collection;
import java.util.HashSet;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

import io.furrow.flink.record.TopicRecord;
import io.furrow.replay.topic.ReplayTopics;
import io.furrow.replay.topic.TopicEnd;

/** Topics that take everything. */
final class OnePartition implements ReplayTopics.Writing {
    TopicEnd end = TopicEnd.EMPTY;

    /** Topics that somebody has deleted. */
    final Set<String> deleted = ConcurrentHashMap.newKeySet();
    /** Why no topic can be prepared; null if each can. */
    volatile String refusal;

    @Override
    public int prepare(String topic) throws IOException {
        if (refusal != null) {
            throw new IOException(refusal);
        }
        deleted.remove(topic);
        return 1;
    }

    @Override
    public Set<String> missing(Collection<String> topics) {
        Set<String> missing = new HashSet<>(topics);
        missing.retainAll(deleted);
        return missing;
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
