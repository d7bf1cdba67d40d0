package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

/**
 * Tracks the last record of each entity on the topic, and whether it may be older than a previous state of the topic or
 * the context broker: then the entity is stale and has to be read again. Uses a bounded part of the heap: the entity
 * that was quiet longest is forgotten. An unknown entity counts as stale if its record is no newer than any forgotten
 * one. Not thread-safe.
 */
final class LastRecordCache {
    /** Per entry besides its identity: the nodes of map and set, two texts, the event id. */
    private static final int ENTRY_BYTES = 320;

    private static final long UNKNOWN = Long.MIN_VALUE;
    private static final long NEVER = Long.MAX_VALUE;

    /** The decision on a record that was read from the context broker. */
    enum Comparison {
        /** The topic does not have this state. */
        NEWS,
        /** The topic's last record has the same state or a newer one. */
        REPEATED,
        /** Another record arrived since the context broker was queried, and their order is unknown. */
        ASK_AGAIN
    }

    private static final class Last {
        private String eventId;
        /** The newest known time of any record so far, epoch milliseconds; the last record may be older. */
        private long modified;

        private long at;
        /** Hash of the subscription; 0 for a repair. */
        private int from;

        private boolean gone;
        private boolean stale;
    }

    private final long maxBytes;
    private final Map<String, Last> entities = new LinkedHashMap<>(16, 0.75f, true);
    private final Set<String> stale = new LinkedHashSet<>();
    private long bytes;
    private long clock;
    private long forgotten = UNKNOWN;
    /** The oldest record of a stale entity that did not fit. */
    private long overflow = NEVER;

    /** @param maxBytes of heap */
    LastRecordCache(long maxBytes) {
        this.maxBytes = maxBytes;
    }

    /** A position in the order of records, to compare later ones with. */
    long now() {
        return clock;
    }

    /**
     * A notification's record was appended to the topic.
     *
     * @return whether its state is new: neither notified before by the same subscription, nor read, nor deleted since
     */
    boolean append(TrackedRecord record, String subscription) {
        long modified = millis(record);
        Last last = entities.get(record.identity());
        long newest = last == null || last.modified == UNKNOWN ? forgotten : last.modified;
        boolean isNew = modified > newest;
        // A repair does not learn when an entity was deleted: earlier changes may be newer than those known so far.
        boolean isSuperseded = last != null && (last.gone || last.stale) && modified <= forgotten;
        boolean isStale;
        if (last == null) {
            last = add(record);
            isStale = modified != UNKNOWN && !isNew;
        } else if (modified == UNKNOWN) {
            isStale = last.stale || last.gone || record.gone();
        } else if (last.modified == UNKNOWN) {
            isStale = last.stale || last.gone && !record.gone() || !isNew;
        } else if (isNew) {
            isStale = last.gone && !record.gone();
        } else {
            boolean repeated = modified == last.modified && record.eventId().equals(last.eventId);
            isStale = repeated ? last.stale : modified < last.modified || !record.gone();
        }
        int from = subscription.hashCode();
        boolean isOther = last.from != 0 && last.from != from && modified == last.modified;
        set(last, record, from);
        last.modified = modified == UNKNOWN ? UNKNOWN : Math.max(modified, newest);
        mark(record, last, isStale);
        return isNew && !isSuperseded || isOther || modified == UNKNOWN;
    }

    /** A record from before the start, of which only the event is known; records since the start are later. */
    void restore(TrackedRecord record) {
        Last last = entities.get(record.identity());
        if (last == null) {
            last = add(record);
            last.modified = UNKNOWN;
        }
        if (last.at == 0) {
            last.eventId = record.eventId();
            last.gone = record.gone();
        }
    }

    /** Decides on a record that was read, and updates the stale entities. */
    Comparison judge(TrackedRecord found, long asked) {
        Last last = entities.get(found.identity());
        if (last == null) {
            return Comparison.NEWS;
        }
        long modified = millis(found);
        boolean came = last.at > asked;
        boolean same = found.gone() ? last.gone : found.eventId().equals(last.eventId);
        if (same) {
            if (!found.gone()) {
                last.modified = came ? Math.max(modified, last.modified) : modified;
            }
            mark(found, last, false);
            return Comparison.REPEATED;
        }
        if (!came || last.modified != UNKNOWN && modified > last.modified) {
            return Comparison.NEWS;
        }
        if (!last.stale && modified != UNKNOWN && modified < last.modified) {
            return Comparison.REPEATED;
        }
        mark(found, last, true);
        return Comparison.ASK_AGAIN;
    }

    /** A record of a read state was appended. */
    void appendFound(TrackedRecord found) {
        Last last = entities.get(found.identity());
        if (last == null) {
            last = add(found);
        }
        set(last, found, 0);
        last.modified = found.gone() ? last.modified : millis(found);
        mark(found, last, false);
    }

    /** An appended record did not become durable: the last record is unknown. */
    void fail(TrackedRecord record) {
        Last last = entities.get(record.identity());
        if (last != null) {
            last.eventId = "";
            last.gone = false;
            mark(record, last, true);
        }
    }

    /** The entity does not belong to this task. */
    void settle(String identity) {
        Last last = entities.get(identity);
        if (last != null) {
            last.stale = false;
        }
        stale.remove(identity);
    }

    /** Changes before this time may have been notified before this task started to track records. */
    void forgetUntil(Instant time) {
        forgotten = Math.max(forgotten, time.toEpochMilli());
    }

    boolean isStale(String identity) {
        return !stale.isEmpty() && stale.contains(identity);
    }

    /** An entity from before the start has to be read again. */
    void restoreStale(String identity) {
        stale.add(identity);
    }

    /** The entities to read again, including forgotten ones; their number is bounded like the entities. */
    List<String> stale() {
        return List.copyOf(stale);
    }

    /**
     * The time from which changes have to be read because more entities were stale than fit since the last call, the
     * beginning if it is unknown; empty if all did fit. A state in the context broker is no older than any record of it.
     */
    Optional<Instant> takeOverflow() {
        long from = overflow;
        overflow = NEVER;
        return from == NEVER ? Optional.empty() : Optional.of(Instant.ofEpochMilli(Math.max(0, from)));
    }

    private Last add(TrackedRecord record) {
        Last last = new Last();
        last.modified = UNKNOWN;
        entities.put(record.identity(), last);
        bytes += bytesOf(record.identity());
        Iterator<Map.Entry<String, Last>> eldest = entities.entrySet().iterator();
        while (bytes > maxBytes && entities.size() > 1) {
            Map.Entry<String, Last> old = eldest.next();
            forgotten = Math.max(forgotten, old.getValue().modified);
            bytes -= bytesOf(old.getKey());
            eldest.remove();
        }
        return last;
    }

    private void set(Last last, TrackedRecord record, int from) {
        last.from = from;
        last.eventId = record.eventId();
        last.gone = record.gone();
        last.at = ++clock;
    }

    private void mark(TrackedRecord record, Last last, boolean isStale) {
        String identity = record.identity();
        last.stale = isStale;
        if (isStale && (stale.size() < maxBytes / ENTRY_BYTES || stale.contains(identity))) {
            stale.add(identity);
        } else if (isStale) {
            overflow = Math.min(overflow, millis(record));
        } else {
            stale.remove(identity);
        }
    }

    private static long millis(TrackedRecord record) {
        return record.modified().map(Instant::toEpochMilli).orElse(UNKNOWN);
    }

    /** At two bytes per character. */
    private static long bytesOf(String identity) {
        return ENTRY_BYTES + 2L * identity.length();
    }
}
