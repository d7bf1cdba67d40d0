package io.furrow.control.replay;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Tracks the topics of finished replays, from {@code service.replays} and {@code service.replays.status}. If the record
 * of a replay on {@code service.replays} was compacted away, its topic is assumed to have the default name.
 */
final class FinishedReplays {
    private final Map<String, DesiredReplay> desired = new HashMap<>();
    /** Topic of each replay that has a status. */
    private final Map<String, String> topics = new HashMap<>();
    /** When each replay was finally over, epoch ms. */
    private final Map<String, Long> finished = new HashMap<>();

    /** @param topic on which it was played */
    record Replay(String replay, String topic) {}

    void take(ConsumerRecord<String, byte[]> record) {
        if (record.key() == null) {
            return;
        }
        try {
            if (record.topic().equals(Topics.REPLAYS)) {
                takeDesired(record.key(), record.value());
            } else {
                takeStatus(record);
            }
        } catch (UnreadableException e) {
            finished.remove(record.key()); // the topic of an unreadable record is not deleted
        }
    }

    private void takeDesired(String replay, byte[] value) throws UnreadableException {
        if (value == null) {
            desired.remove(replay);
            return;
        }
        DesiredReplay read = DesiredReplay.read(replay, value);
        desired.put(replay, read);
        topics.put(replay, read.topic());
    }

    private void takeStatus(ConsumerRecord<String, byte[]> record) throws UnreadableException {
        finished.remove(record.key());
        if (record.value() == null) {
            topics.remove(record.key());
            return;
        }
        ReplayStatus status = ReplayStatus.read(record.value());
        if (status.state().isOver() && status.settled()) {
            finished.put(record.key(), record.timestamp());
        }
    }

    /** Returns the replays that were over by a time and are not desired. @param time epoch ms */
    List<Replay> finishedBy(long time) {
        return finished.entrySet().stream()
                .filter(each -> each.getValue() <= time && !desired.containsKey(each.getKey()))
                .map(each -> new Replay(each.getKey(), topicOf(each.getKey())))
                .filter(each -> !isUsed(each.topic()))
                .filter(each -> finished.entrySet().stream()
                        .noneMatch(other -> other.getValue() > time
                                && topicOf(other.getKey()).equals(each.topic())))
                .toList();
    }

    /** Whether a desired replay plays to the topic or from it. */
    boolean isUsed(String topic) {
        return desired.values().stream().anyMatch(replay -> uses(replay, topic));
    }

    /** Whether the replay plays to the topic, from it, or from its results. */
    private static boolean uses(DesiredReplay replay, String topic) {
        ReplayPlan.Source source = replay.plan().source();
        String played = source == null || source.topic() == null ? "" : source.topic();
        return replay.topic().equals(topic) || played.equals(topic) || played.startsWith(topic + ".");
    }

    private String topicOf(String replay) {
        int dot = replay.lastIndexOf('.');
        String called = dot < 0 ? replay : "data." + replay.substring(0, dot) + ".replay" + replay.substring(dot);
        return topics.getOrDefault(replay, called);
    }
}
