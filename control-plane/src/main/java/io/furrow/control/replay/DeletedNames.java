package io.furrow.control.replay;

import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * The topics of missions and domains that were deleted, by {@code service.missions} and {@code service.domains}. Where the record
 * of a mission is compacted away, and with it its domain, the topic is looked for in all domains, and left alone if several have it.
 */
final class DeletedNames {
    private final Map<String, String> topics = new HashMap<>();
    /** When its mission or domain was deleted, epoch ms. */
    private final Map<String, Long> deleted = new HashMap<>();
    /** Also those that were deleted. */
    private final Set<String> domains = new HashSet<>();
    /** Missions of which only the deletion is known, and when that was, epoch ms. */
    private final Map<String, Long> withoutDomain = new HashMap<>();

    void take(ConsumerRecord<String, byte[]> record) {
        if (record.key() == null) {
            return;
        }
        boolean isDomain = record.topic().equals(Topics.DOMAINS);
        if (isDomain) {
            domains.add(record.key());
        }
        String name = record.topic() + " " + record.key();
        if (record.value() != null) {
            String topic = isDomain ? Topics.realtime(record.key()) : ofMission(record);
            topics.put(name, topic);
            deleted.remove(topic);
            if (!isDomain) {
                withoutDomain.remove(record.key());
            }
            return;
        }
        String topic = topics.remove(name);
        if (topic != null) {
            deleted.put(topic, record.timestamp());
        } else if (isDomain) {
            deleted.put(Topics.realtime(record.key()), record.timestamp());
        } else {
            withoutDomain.put(record.key(), record.timestamp());
        }
    }

    /** Whether topics have to be looked for. */
    boolean lackDomains() {
        return !withoutDomain.isEmpty();
    }

    /** Looks for the topics of missions whose domain is not known. */
    void find(Set<String> there) {
        withoutDomain.forEach((mission, time) -> {
            List<String> found = domains.stream()
                    .map(domain -> Topics.realtime(domain, mission))
                    .filter(topic -> there.contains(topic) && !topics.containsValue(topic))
                    .toList();
            if (found.size() == 1) { // of several, devices may have named the others
                deleted.put(found.get(0), time);
            }
        });
        withoutDomain.clear();
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
