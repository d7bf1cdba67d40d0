package io.furrow.control.replay;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * The topics of missions and domains that were deleted, by {@code service.missions} and {@code service.domains}. A mission whose record
 * is compacted away has none: which domain it was in is not known, and a topic of its name in another is that of devices.
 */
final class DeletedNames {
    private final Map<String, String> topics = new HashMap<>();
    /** When its mission or domain was deleted, epoch ms. */
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

    /** Null if the record cannot be read. */
    private static String ofMission(ConsumerRecord<String, byte[]> record) {
        try {
            String domain = NgsiJson.read(record.value()).path("domain").asText();
            return Topics.realtime(domain, record.key());
        } catch (UnreadableException e) {
            return null;
        }
    }

    /** @param moment epoch ms by which they were deleted */
    List<String> by(long moment) {
        return deleted.entrySet().stream()
                .filter(each -> each.getValue() <= moment)
                .map(Map.Entry::getKey)
                .toList();
    }

    /** Its topic is gone. */
    void forget(String topic) {
        deleted.remove(topic);
    }
}
