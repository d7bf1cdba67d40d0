package io.furrow.replay.recording;

import java.io.Serializable;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.topic.TopicRecordings;
import io.furrow.model.control.DesiredReplay;

/** Opens topics as recordings. Serializable, so that a job can carry it. */
@FunctionalInterface
public interface TopicHistories extends Serializable {
    /** Returns the topics of this Kafka cluster up to the creation of the replay. */
    static TopicHistories of(Properties kafka) {
        TreeMap<String, String> settings = new TreeMap<>();
        kafka.stringPropertyNames().forEach(name -> settings.put(name, kafka.getProperty(name)));
        return (topic, replay) -> new TopicRecordings(settings, replay.created()).open(topic);
    }

    /**
     * Opens a topic; empty if it does not exist.
     *
     * @throws RecordingException if that cannot be determined now
     */
    Optional<Recording> open(String topic, DesiredReplay replay) throws RecordingException;
}
