package io.furrow.soak.source;

import java.util.BitSet;
import java.util.HashMap;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;

/** What of the numbered notifications is on {@code data.raw}, committed; grows with each reading. */
final class DeliveredNotifications implements AutoCloseable {
    private final CommittedRecords records;
    private final Map<Integer, String> events = new HashMap<>();
    private int repeated;
    private int repeatedWithAnotherId;

    DeliveredNotifications(String bootstrapServers) {
        records = new CommittedRecords(bootstrapServers);
    }

    /** Reads to the end that the topic has now. */
    void read() {
        records.read(this::count);
    }

    private void count(ConsumerRecord<String, byte[]> record) {
        int number = Integer.parseInt(record.key().substring(record.key().lastIndexOf(':') + 1));
        String event = new String(record.headers().lastHeader(HeaderNames.CE_ID).value(), UTF_8);
        String before = events.putIfAbsent(number, event);
        if (before != null) {
            repeated++;
            repeatedWithAnotherId += before.equals(event) ? 0 : 1;
        }
    }

    /** How many of these are not there. */
    int missingOf(BitSet acknowledged) {
        return (int) acknowledged.stream()
                .filter(number -> !events.containsKey(number))
                .count();
    }

    int count() {
        return events.size();
    }

    /** Records that were there before. */
    int repeated() {
        return repeated;
    }

    /** Those of them whose {@code ce_id} differs from the first. */
    int repeatedWithAnotherId() {
        return repeatedWithAnotherId;
    }

    @Override
    public void close() {
        records.close();
    }
}
