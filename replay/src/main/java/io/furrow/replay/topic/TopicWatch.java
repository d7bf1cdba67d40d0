package io.furrow.replay.topic;

import java.io.IOException;
import java.time.Duration;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.DaemonThreads;

/**
 * Checks at an interval whether the topics of running replays exist. A deleted topic is created again before its replay
 * is notified, because a record for a missing topic delays the records of all other replays. A topic counts as deleted
 * if two checks miss it, because a broker may learn of a topic late, or if its id has changed, because a broker may
 * create a missing topic for any producer.
 */
public final class TopicWatch implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TopicWatch.class);

    private final ReplayTopics.Writing topics;
    private final Map<String, Watched> watched = new ConcurrentHashMap<>();
    private final ScheduledExecutorService thread;
    private final Map<String, String> ids = new ConcurrentHashMap<>();
    private Set<String> missedBefore = Set.of();

    /** The replay of a topic. Called by the watching thread. */
    public interface Watched {
        boolean isPlaying();

        /** @param partitions of the new topic; 0 if it could not be created */
        void deleted(int partitions);
    }

    public TopicWatch(ReplayTopics.Writing topics, Duration interval) {
        this.topics = topics;
        thread = Executors.newSingleThreadScheduledExecutor(DaemonThreads.named("replay-topics"));
        thread.scheduleWithFixedDelay(this::check, interval.toMillis(), interval.toMillis(), TimeUnit.MILLISECONDS);
    }

    public void add(String topic, Watched player) {
        watched.put(topic, player);
        ids.remove(topic);
    }

    public void remove(String topic) {
        watched.remove(topic);
    }

    private void check() {
        List<String> played = watched.entrySet().stream()
                .filter(each -> each.getValue().isPlaying())
                .map(Map.Entry::getKey)
                .toList();
        try {
            Map<String, String> found = played.isEmpty() ? Map.of() : topics.ids(played);
            Set<String> missing = new HashSet<>(played);
            missing.removeAll(found.keySet());
            Set<String> deleted = new HashSet<>(missing);
            deleted.retainAll(missedBefore);
            ids.keySet().retainAll(played);
            found.forEach((topic, id) -> {
                String before = ids.put(topic, id);
                if (before != null && !before.equals(id)) {
                    deleted.add(topic);
                }
            });
            for (String topic : deleted) {
                replace(topic);
                ids.remove(topic);
            }
            missedBefore = missing;
        } catch (IOException e) {
            LOG.debug("Cannot check the topics of replays, retrying", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private void replace(String topic) throws InterruptedException {
        int partitions = 0;
        try {
            partitions = topics.prepare(topic);
        } catch (IOException e) {
            LOG.warn("Topic {} was deleted while a replay was writing to it, and cannot be created again", topic, e);
        }
        Watched player = watched.get(topic);
        if (player != null) {
            player.deleted(partitions);
        }
    }

    @Override
    public void close() {
        thread.shutdownNow();
    }
}
