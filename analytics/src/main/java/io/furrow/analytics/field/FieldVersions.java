package io.furrow.analytics.field;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.NavigableMap;
import java.util.Optional;
import java.util.OptionalLong;
import java.util.TreeMap;
import java.util.TreeSet;

import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;

import io.furrow.analytics.field.FieldIndex.Interval;
import io.furrow.analytics.field.FieldIndex.Located;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.Position;

/**
 * All versions of all fields, as known to one subtask; queries are as of the original time of an event time. A version holds from its
 * {@code validFrom} until that of the field's next version. Not thread-safe.
 *
 * <p>Needs no Flink state: the topic is compacted, retains every version, and is read to its end whenever the subtask opens. The stream
 * that follows repeats those records; they are skipped by offset.
 */
public final class FieldVersions {
    /** Flink requires a descriptor of broadcast state; it stays empty. */
    public static final MapStateDescriptor<String, String> BROADCAST =
            new MapStateDescriptor<>("fields", Types.STRING, Types.STRING);

    private final Map<String, NavigableMap<Long, Optional<Located>>> versions = new HashMap<>();
    private final Map<Integer, Long> passed = new HashMap<>();
    private final TreeSet<Long> changes = new TreeSet<>();
    private FieldIndex index = new FieldIndex(List.of());
    private boolean stale;

    private FieldVersions() {}

    /** Must be called in {@code open}, before the first event, also after restarts. */
    public static FieldVersions read(TopicSnapshot atStart) throws IOException {
        FieldVersions known = new FieldVersions();
        for (TopicRecord record : atStart.read()) {
            known.take(record);
        }
        return known;
    }

    /**
     * Applies a record of the broadcast stream. A record that is not a version of a field is skipped: {@link ParseFields} has made a dead
     * letter of it.
     *
     * @return whether it changed anything
     */
    public boolean take(TopicRecord record) {
        if (record.offset() <= passed.getOrDefault(record.partition(), -1L)) {
            return false;
        }
        passed.put(record.partition(), record.offset());
        try {
            take(FieldVersionChange.read(record));
            return true;
        } catch (UnreadableException e) {
            return false;
        }
    }

    private void take(FieldVersionChange change) {
        stale = true;
        NavigableMap<Long, Optional<Located>> ofField =
                versions.computeIfAbsent(change.key().id(), id -> new TreeMap<>());
        if (change.isTaken()) {
            ofField.remove(change.key().validFrom());
        } else {
            ofField.put(
                    change.key().validFrom(),
                    Optional.ofNullable(change.field()).map(Located::new));
        }
        if (ofField.isEmpty()) {
            versions.remove(change.key().id());
        }
    }

    /** Rebuilds the index lazily, so that a thousand fields at the start need one rebuild. */
    private void refresh() {
        if (!stale) {
            return;
        }
        List<Interval> spans = new ArrayList<>();
        changes.clear();
        for (NavigableMap<Long, Optional<Located>> ofField : versions.values()) {
            changes.addAll(ofField.keySet());
            ofField.forEach((from, located) -> {
                Long next = ofField.higherKey(from);
                located.ifPresent(area -> spans.add(new Interval(area, next == null ? Long.MAX_VALUE : next)));
            });
        }
        index = new FieldIndex(spans);
        stale = false;
    }

    /** The fields that cover a position at an event time in epoch ms, unordered. The border counts, also that of a hole. */
    public List<Field> covering(Position position, long time) {
        refresh();
        return index.covering(position, Epochs.original(time));
    }

    /** The field as of an event time; empty if none of that id exists at that time. */
    public Optional<Field> at(String id, long time) {
        NavigableMap<Long, Optional<Located>> ofField = versions.get(id);
        Map.Entry<Long, Optional<Located>> last = ofField == null ? null : ofField.floorEntry(Epochs.original(time));
        return last == null ? Optional.empty() : last.getValue().map(Located::field);
    }

    /** The next time, after an event time and in its epoch, at which any field begins, changes or ends. */
    public OptionalLong nextChange(long after) {
        refresh();
        Long next = changes.higher(Epochs.original(after));
        return next == null ? OptionalLong.empty() : OptionalLong.of(Epochs.begin(after) + next);
    }
}
