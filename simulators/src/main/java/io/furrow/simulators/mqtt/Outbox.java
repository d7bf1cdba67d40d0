package io.furrow.simulators.mqtt;

import java.util.HashMap;
import java.util.Map;
import java.util.TreeMap;

/**
 * Messages until the broker has acknowledged them: waiting to be sent, in order, or under way. What was under way when the
 * connection broke waits again, before what is newer. When too many wait the oldest is dropped and counted.
 */
final class Outbox {
    private final int most;
    private final TreeMap<Long, Message> waiting = new TreeMap<>();
    private final Map<Long, Message> underWay = new HashMap<>();
    private long number;
    private long acknowledged;
    private long dropped;

    record Message(String topic, byte[] payload) {}

    /** @param most messages that may wait */
    Outbox(int most) {
        this.most = most;
    }

    void add(Message message) {
        waiting.put(number++, message);
        if (waiting.size() > most) {
            waiting.pollFirstEntry();
            dropped++;
        }
    }

    /** The message to be sent next, with its number; null where none waits. */
    Map.Entry<Long, Message> first() {
        return waiting.firstEntry();
    }

    void sent(long sent) {
        underWay.put(sent, waiting.remove(sent));
    }

    /** The acknowledgement may come late, when the message waits again. */
    void acknowledged(long sent) {
        if (underWay.remove(sent) != null || waiting.remove(sent) != null) {
            acknowledged++;
        }
    }

    /** The connection is broken: nothing that was under way is sure to have arrived. */
    void broken() {
        waiting.putAll(underWay);
        underWay.clear();
    }

    int underWay() {
        return underWay.size();
    }

    /** Messages that are not acknowledged yet. */
    int open() {
        return waiting.size() + underWay.size();
    }

    long acknowledged() {
        return acknowledged;
    }

    long dropped() {
        return dropped;
    }
}
