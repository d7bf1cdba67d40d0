package io.furrow.control.rest;

import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentSkipListMap;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * What is on the compacted topics of the control plane, and the end of its audit topic. Held as bytes, because trees take ten times
 * the room; whoever reads gets a tree of his own.
 */
final class ServiceView {
    /** The topics that are held whole. */
    static final List<String> TOPICS = List.of(
            Topics.DOMAINS,
            Topics.MISSIONS,
            Topics.MISSION_DEVICES,
            Topics.MISSIONS_STATUS,
            Topics.TEMPLATES,
            Topics.DEVICES,
            Topics.DEVICES_STATUS,
            Topics.DEVICES_HEALTH,
            Topics.REPLAYS,
            Topics.REPLAYS_STATUS,
            Topics.ALARMS);

    /** How many entries of the audit topic are held. */
    static final int AUDITED = 1000;

    private final Map<String, Map<String, byte[]>> byTopic = new ConcurrentHashMap<>();
    private final Deque<byte[]> audited = new ArrayDeque<>();
    private volatile boolean complete;

    /** What is under a key of a topic. */
    record Entry(String key, ObjectNode value) {}

    /** Begins anew; nothing can be read until {@link #complete()}. */
    void clear() {
        complete = false;
        TOPICS.forEach(topic -> byTopic.put(topic, new ConcurrentSkipListMap<>()));
        synchronized (audited) {
            audited.clear();
        }
    }

    /** @param value a JSON object; null takes it away */
    void put(String topic, String key, byte[] value) {
        if (value == null) {
            byTopic.get(topic).remove(key);
        } else {
            byTopic.get(topic).put(key, value);
        }
    }

    void audit(byte[] entry) {
        synchronized (audited) {
            audited.addFirst(entry);
            if (audited.size() > AUDITED) {
                audited.removeLast();
            }
        }
    }

    void complete() {
        complete = true;
    }

    boolean isComplete() {
        return complete;
    }

    /** @throws ProblemException where the topics were not read to their ends yet */
    Optional<ObjectNode> find(String topic, String key) {
        return Optional.ofNullable(read(topic).get(key)).map(ServiceView::parse);
    }

    /** In the order of the keys. @throws ProblemException as {@link #find} */
    Stream<ObjectNode> all(String topic) {
        return read(topic).values().stream().map(ServiceView::parse);
    }

    /** With their keys, in their order. @throws ProblemException as {@link #find} */
    Stream<Entry> entries(String topic) {
        return read(topic).entrySet().stream().map(each -> new Entry(each.getKey(), parse(each.getValue())));
    }

    private Map<String, byte[]> read(String topic) {
        if (!complete) {
            throw ProblemException.notReady();
        }
        return byTopic.get(topic);
    }

    /** The newest first. @throws ProblemException as {@link #find} */
    Stream<ObjectNode> newestAudited(int most) {
        if (!complete) {
            throw ProblemException.notReady();
        }
        List<byte[]> entries;
        synchronized (audited) {
            entries = audited.stream().limit(most).toList();
        }
        return entries.stream().map(ServiceView::parse);
    }

    private static ObjectNode parse(byte[] value) {
        try {
            return (ObjectNode) NgsiJson.read(value);
        } catch (UnreadableException e) {
            throw new IllegalStateException("what was put is no JSON object", e);
        }
    }
}
