package io.furrow.soak.source;

import java.util.BitSet;
import java.util.HashMap;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Counts the committed records of numbered notifications on {@code data.raw}; each read adds the new ones. */
final class DeliveredNotifications implements AutoCloseable {
    private final CommittedRecords records;
    private final Map<Integer, String> events = new HashMap<>();
    private int repeated;
    private int repeatedWithAnotherId;

    DeliveredNotifications(String bootstrapServers) {
        records = new CommittedRecords(bootstrapServers);
    }

    /** Reads to the current end of the topic. */
    void read() {
        records.read(this::count);
    }

    private void count(ConsumerRecord<String, byte[]> record) {
        int number = Integer.parseInt(record.key().substring(record.key().lastIndexOf(':') + 1));
        String event = new String(record.headers().lastHeader(HeaderNames.CE_ID).value(), UTF_8);
        String existing = events.putIfAbsent(number, event);
        if (existing != null) {
            repeated++;
            repeatedWithAnotherId += existing.equals(event) ? 0 : 1;
        }
    }

    /** The number of acknowledged notifications that are missing. */
    int missingOf(BitSet acknowledged) {
        return (int) acknowledged.stream()
                .filter(number -> !events.containsKey(number))
                .count();
    }

    int count() {
        return events.size();
    }

    /** The number of repeated records. */
    int repeated() {
        return repeated;
    }

    /** The number of repeated records whose {@code ce_id} differs from the first. */
    int repeatedWithAnotherId() {
        return repeatedWithAnotherId;
    }

    @Override
    public void close() {
        records.close();
    }
}
