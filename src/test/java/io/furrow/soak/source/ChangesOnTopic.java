package io.furrow.soak.source;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.Header;

import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Which changes are on {@code data.raw}, committed; grows with each reading. */
final class ChangesOnTopic implements AutoCloseable {
    private final CommittedRecords records;
    private final Map<NumberedChange, Integer> notified = new HashMap<>();
    private final Map<NumberedChange, String> ids = new HashMap<>();
    private final Map<Integer, Integer> newest = new HashMap<>();
    private final Map<Integer, Integer> last = new HashMap<>();
    private int repaired;
    private int differentIds;

    ChangesOnTopic(String bootstrapServers) {
        records = new CommittedRecords(bootstrapServers);
    }

    /** Reads to the end that the topic has now. */
    void read() {
        records.read(this::count);
    }

    private void count(ConsumerRecord<String, byte[]> record) {
        NumberedChange change = change(record);
        if (text(record, HeaderNames.ORIGIN).equals("repair")) {
            repaired++;
        } else {
            notified.merge(change, 1, Integer::sum);
        }
        String id = text(record, HeaderNames.CE_ID);
        String before = ids.putIfAbsent(change, id);
        differentIds += before == null || before.equals(id) ? 0 : 1;
        newest.merge(change.entity(), change.number(), Math::max);
        last.put(change.entity(), change.number());
    }

    private static NumberedChange change(ConsumerRecord<String, byte[]> record) {
        try {
            return NumberedChange.read(record.value());
        } catch (IOException e) {
            throw new UncheckedIOException("a record that is not an entity: " + record, e);
        }
    }

    private static String text(ConsumerRecord<?, ?> record, String name) {
        Header header = record.headers().lastHeader(name);
        return header == null ? "" : new String(header.value(), UTF_8);
    }

    /** Records of this change that a notification brought. */
    int notified(NumberedChange change) {
        return notified.getOrDefault(change, 0);
    }

    /** Whether the newest that is known of each of these entities is this. */
    List<NumberedChange> notNewest(List<NumberedChange> expected) {
        List<NumberedChange> other = new ArrayList<>();
        for (NumberedChange change : expected) {
            if (newest.getOrDefault(change.entity(), -1) != change.number()) {
                other.add(change);
            }
        }
        return other;
    }

    /** Entities whose last record is older than another before it. */
    int lastIsOlder() {
        return (int) last.entrySet().stream()
                .filter(entity -> entity.getValue() < newest.get(entity.getKey()))
                .count();
    }

    int count() {
        return notified.values().stream().mapToInt(Integer::intValue).sum();
    }

    /** Records that the repair brought. */
    int repaired() {
        return repaired;
    }

    /** Records of a change that had a record with another {@code ce_id} before. */
    int differentIds() {
        return differentIds;
    }

    @Override
    public void close() {
        records.close();
    }
}
