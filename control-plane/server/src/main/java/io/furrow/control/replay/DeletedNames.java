package io.furrow.control.replay;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Tracks the topics of deleted missions and domains, from {@code service.missions} and {@code service.domains}. A
 * mission whose record was compacted away before it was read has none, because its domain is unknown.
 */
final class DeletedNames {
    private final Map<String, String> topics = new HashMap<>();
    /** Time of deletion by topic, epoch ms. */
    private final Map<String, Long> deleted = new HashMap<>();

    void take(ConsumerRecord<String, byte[]> record) {
        if (record.key() == null) {
            return;
        }
        boolean isDomain = record.topic().equals(Topics.DOMAINS);
        String name = record.topic() + " " + record.key();
        if (record.value() != null) {
            String topic = isDomain ? Topics.realtime(record.key()) : ofMission(record);
            topics.put(name, topic);
            deleted.remove(topic);
            return;
        }
        String topic = topics.remove(name);
        if (topic != null) {
            deleted.put(topic, record.timestamp());
        } else if (isDomain) {
            deleted.put(Topics.realtime(record.key()), record.timestamp());
        }
    }

    /** Returns the topic of a mission; null if the record cannot be read. */
    private static String ofMission(ConsumerRecord<String, byte[]> record) {
        try {
            String domain = NgsiJson.read(record.value()).path("domain").asText();
            return Topics.realtime(domain, record.key());
        } catch (UnreadableException e) {
            return null;
        }
    }

    /** Returns the topics whose owners were deleted by a time. @param time epoch ms */
    List<String> deletedBy(long time) {
        return deleted.entrySet().stream()
                .filter(each -> each.getValue() <= time)
                .map(Map.Entry::getKey)
                .toList();
    }

    /** Called when the topic was deleted. */
    void forget(String topic) {
        deleted.remove(topic);
    }
}
