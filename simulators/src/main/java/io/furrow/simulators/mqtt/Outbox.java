package io.furrow.simulators.mqtt;

import java.util.Map;
import java.util.TreeMap;

/**
 * Messages until the broker has acknowledged them: waiting to be sent, in order, or under way. What was under way when the
 * connection broke waits again, before what is newer. When too many wait, or what waits is too large, the oldest are dropped and
 * counted.
 */
final class Outbox {
    private static final int BYTES_BESIDES = 250;

    private final int most;
    private final long mostBytes;
    private final TreeMap<Long, Message> waiting = new TreeMap<>();
    private final TreeMap<Long, Message> underWay = new TreeMap<>();
    private long number;
    private long acknowledged;
    private long dropped;
    private long bytes;

    record Message(String topic, byte[] payload) {
        /** What it takes of the memory, about. */
        long bytes() {
            return payload.length + topic.length() + BYTES_BESIDES;
        }
    }

    /**
     * @param most messages that may wait
     * @param mostBytes that they may take while waiting or under way, about
     */
    Outbox(int most, long mostBytes) {
        this.most = most;
        this.mostBytes = mostBytes;
    }

    void add(Message message) {
        waiting.put(number++, message);
        bytes += message.bytes();
        while (waiting.size() > most || bytes > mostBytes && waiting.size() > 1) {
            bytes -= waiting.pollFirstEntry().getValue().bytes();
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
        Message message = underWay.remove(sent);
        if (message == null) {
            message = waiting.remove(sent);
        }
        if (message != null) {
            acknowledged++;
            bytes -= message.bytes();
        }
    }

    /** The connection is broken: nothing that was under way is sure to have arrived. */
    void broken() {
        waiting.putAll(underWay);
        underWay.clear();
    }

    /** The number of the message that is under way for longest; null where none is. */
    Long oldestUnderWay() {
        return underWay.isEmpty() ? null : underWay.firstKey();
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
