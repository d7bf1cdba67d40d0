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

/** Topics with one partition that accept records of any size. */
final class OnePartition implements ReplayTopics.Writing {
    TopicEnd end = TopicEnd.EMPTY;

    /** Number of requests for topic ids. */
    volatile int idRequests;

    /** Deleted topics. */
    final Set<String> deleted = ConcurrentHashMap.newKeySet();
    /** Deleted topics that the broker has created again. */
    final Set<String> recreated = ConcurrentHashMap.newKeySet();
    /** Why no topic can be prepared; null if all can. */
    volatile String problem;

    @Override
    public int prepare(String topic) throws IOException {
        if (problem != null) {
            throw new IOException(problem);
        }
        deleted.remove(topic);
        return 1;
    }

    @Override
    public Map<String, String> ids(Collection<String> topics) {
        idRequests++;
        return topics.stream()
                .filter(topic -> !deleted.contains(topic))
                .collect(Collectors.toMap(topic -> topic, topic -> recreated.contains(topic) ? "2" : "1"));
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
        // no resources
    }
}
