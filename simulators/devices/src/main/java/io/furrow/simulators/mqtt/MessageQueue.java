package io.furrow.simulators.mqtt;

import java.util.Map;
import java.util.TreeMap;

/**
 * Stores messages until the broker has acknowledged them: waiting, in order, or in flight. After a disconnect those in
 * flight wait again, before newer ones. When too many or too large messages wait, the oldest are dropped and counted.
 */
final class MessageQueue {
    private static final int BYTES_BESIDES = 250;

    private final int maxMessages;
    private final long maxBytes;
    private final TreeMap<Long, Message> waiting = new TreeMap<>();
    private final TreeMap<Long, Message> inFlight = new TreeMap<>();
    private long number;
    private long acknowledged;
    private long dropped;
    private long bytes;

    record Message(String topic, byte[] payload) {
        /** Approximate memory use. */
        long bytes() {
            return payload.length + topic.length() + BYTES_BESIDES;
        }
    }

    /**
     * @param maxMessages waiting messages
     *
     * @param maxBytes memory of all messages, approximate
     */
    MessageQueue(int maxMessages, long maxBytes) {
        this.maxMessages = maxMessages;
        this.maxBytes = maxBytes;
    }

    void add(Message message) {
        waiting.put(number++, message);
        bytes += message.bytes();
        while (waiting.size() > maxMessages || bytes > maxBytes && waiting.size() > 1) {
            bytes -= waiting.pollFirstEntry().getValue().bytes();
            dropped++;
        }
    }

    /** The next message to send, with its number; null if none waits. */
    Map.Entry<Long, Message> first() {
        return waiting.firstEntry();
    }

    void sent(long sent) {
        inFlight.put(sent, waiting.remove(sent));
    }

    /** Accepts an acknowledgement, also a late one, when the message waits again. */
    void acknowledged(long sent) {
        Message message = inFlight.remove(sent);
        if (message == null) {
            message = waiting.remove(sent);
        }
        if (message != null) {
            acknowledged++;
            bytes -= message.bytes();
        }
    }

    /** After a disconnect no message in flight is sure to have arrived. */
    void broken() {
        waiting.putAll(inFlight);
        inFlight.clear();
    }

    /** The number of the oldest message in flight; null if none is. */
    Long oldestInFlight() {
        return inFlight.isEmpty() ? null : inFlight.firstKey();
    }

    int inFlight() {
        return inFlight.size();
    }

    /** Messages not acknowledged yet. */
    int open() {
        return waiting.size() + inFlight.size();
    }

    long acknowledged() {
        return acknowledged;
    }

    long dropped() {
        return dropped;
    }
}
