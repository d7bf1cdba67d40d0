package io.furrow.replay.source;

import java.io.IOException;
import java.util.Collection;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Collectors;

import io.furrow.flink.record.TopicRecord;
import io.furrow.replay.topic.ReplayTopics;
import io.furrow.replay.topic.TopicEnd;

/** Topics that take everything. */
final class OnePartition implements ReplayTopics.Writing {
    TopicEnd end = TopicEnd.EMPTY;

    /** How often it was asked which topics are there. */
    volatile int asked;

    /** Topics that somebody has deleted. */
    final Set<String> deleted = ConcurrentHashMap.newKeySet();
    /** Topics that somebody has deleted, and the broker has made again. */
    final Set<String> madeAgain = ConcurrentHashMap.newKeySet();
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
    public Map<String, String> ids(Collection<String> topics) {
        asked++;
        return topics.stream()
                .filter(topic -> !deleted.contains(topic))
                .collect(Collectors.toMap(topic -> topic, topic -> madeAgain.contains(topic) ? "2" : "1"));
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
