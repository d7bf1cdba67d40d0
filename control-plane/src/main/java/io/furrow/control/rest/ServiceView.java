package io.furrow.control.rest;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentSkipListMap;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.topic.Topics;

/** What is on the compacted topics of the control plane, and the end of its audit topic. Values are not to be changed. */
final class ServiceView {
    /** The topics that are held whole. */
    static final List<String> TOPICS = List.of(
            Topics.DOMAINS,
            Topics.MISSIONS,
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

    private final Map<String, Map<String, ObjectNode>> byTopic = new ConcurrentHashMap<>();
    private final Deque<ObjectNode> audited = new ArrayDeque<>();
    private volatile boolean complete;

    /** Begins anew; nothing can be read until {@link #complete()}. */
    void clear() {
        complete = false;
        TOPICS.forEach(topic -> byTopic.put(topic, new ConcurrentSkipListMap<>()));
        synchronized (audited) {
            audited.clear();
        }
    }

    /** @param value null takes it away */
    void put(String topic, String key, ObjectNode value) {
        if (value == null) {
            byTopic.get(topic).remove(key);
        } else {
            byTopic.get(topic).put(key, value);
        }
    }

    void audit(ObjectNode entry) {
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
        return Optional.ofNullable(read(topic).get(key));
    }

    /** In the order of the keys. @throws ProblemException as {@link #find} */
    Collection<ObjectNode> all(String topic) {
        return read(topic).values();
    }

    /** With their keys, in their order. @throws ProblemException as {@link #find} */
    Map<String, ObjectNode> read(String topic) {
        if (!complete) {
            throw ProblemException.notReady();
        }
        return byTopic.get(topic);
    }

    /** The newest first. @throws ProblemException as {@link #find} */
    List<ObjectNode> newestAudited(int most) {
        if (!complete) {
            throw ProblemException.notReady();
        }
        synchronized (audited) {
            return new ArrayList<>(audited).subList(0, Math.min(most, audited.size()));
        }
    }
}
