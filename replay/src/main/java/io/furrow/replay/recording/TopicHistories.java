package io.furrow.replay.recording;

import java.io.Serializable;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.topic.TopicRecordings;
import io.furrow.model.control.DesiredReplay;

/** Recordings that are topics with their own history. Serializable, so that a job can carry it. */
@FunctionalInterface
public interface TopicHistories extends Serializable {
    /** Topics of this Kafka; what came after the replay was asked for is not a part of it. */
    static TopicHistories of(Properties kafka) {
        TreeMap<String, String> settings = new TreeMap<>();
        kafka.stringPropertyNames().forEach(name -> settings.put(name, kafka.getProperty(name)));
        return (topic, replay) -> new TopicRecordings(settings, replay.created()).open(topic);
    }

    /**
     * Empty if there is no such topic.
     *
     * @throws RecordingException if it cannot be determined now
     */
    Optional<Recording> open(String topic, DesiredReplay replay) throws RecordingException;
}
