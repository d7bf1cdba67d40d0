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

/** Counts the committed changes on {@code data.raw}; each read adds the new ones. */
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

    /** Reads to the current end of the topic. */
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
        String existing = ids.putIfAbsent(change, id);
        differentIds += existing == null || existing.equals(id) ? 0 : 1;
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

    /** The number of records of a change that come from notifications. */
    int notified(NumberedChange change) {
        return notified.getOrDefault(change, 0);
    }

    /** Changes that are not the newest ones on the topic for their entity. */
    List<NumberedChange> notNewest(List<NumberedChange> expected) {
        List<NumberedChange> other = new ArrayList<>();
        for (NumberedChange change : expected) {
            if (newest.getOrDefault(change.entity(), -1) != change.number()) {
                other.add(change);
            }
        }
        return other;
    }

    /** The number of entities whose last record is older than an earlier one. */
    int lastIsOlder() {
        return (int) last.entrySet().stream()
                .filter(entity -> entity.getValue() < newest.get(entity.getKey()))
                .count();
    }

    int count() {
        return notified.values().stream().mapToInt(Integer::intValue).sum();
    }

    /** The number of records that the repair wrote. */
    int repaired() {
        return repaired;
    }

    /** The number of records of a change that differ in {@code ce_id} from its first record. */
    int differentIds() {
        return differentIds;
    }

    @Override
    public void close() {
        records.close();
    }
}
