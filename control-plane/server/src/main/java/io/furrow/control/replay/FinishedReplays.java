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
 * What is left of replays that are over, by {@code service.replays} and {@code service.replays.status}. A replay whose record of {@code
 * service.replays} is compacted away is taken to have had the topic that is called after it.
 */
final class FinishedReplays {
    private final Map<String, DesiredReplay> desired = new HashMap<>();
    /** Of each replay whose status is there. */
    private final Map<String, String> topics = new HashMap<>();
    /** When each that is over for good was so, epoch ms. */
    private final Map<String, Long> over = new HashMap<>();

    /** @param topic on which it was played */
    record Remains(String replay, String topic) {}

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
            over.remove(record.key()); // what cannot be read is not deleted
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
        over.remove(record.key());
        if (record.value() == null) {
            topics.remove(record.key());
            return;
        }
        ReplayStatus status = ReplayStatus.read(record.value());
        if (status.state().isOver() && status.settled()) {
            over.put(record.key(), record.timestamp());
        }
    }

    /** Those that were over by a moment, and that nobody wants. @param moment epoch ms */
    List<Remains> overBy(long moment) {
        return over.entrySet().stream()
                .filter(each -> each.getValue() <= moment && !desired.containsKey(each.getKey()))
                .map(each -> new Remains(each.getKey(), topicOf(each.getKey())))
                .filter(each -> !isUsed(each.topic()))
                .filter(each -> over.entrySet().stream()
                        .noneMatch(other -> other.getValue() > moment
                                && topicOf(other.getKey()).equals(each.topic())))
                .toList();
    }

    /** Whether a replay that is wanted plays on the topic, or from it. */
    boolean isUsed(String topic) {
        return desired.values().stream().anyMatch(replay -> uses(replay, topic));
    }

    /** Plays on it, or from it or from what was found in it. */
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
