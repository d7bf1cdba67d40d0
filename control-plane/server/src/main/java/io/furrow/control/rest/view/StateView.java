package io.furrow.control.rest.view;

import java.util.ArrayDeque;
import java.util.Collection;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.UUID;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentSkipListMap;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/**
 * Caches the compacted topics of the control plane and the end of its audit topic. Values are held as bytes, because
 * trees need ten times the memory; every read returns a new tree.
 */
public final class StateView {
    /** The topics that are cached completely. */
    static final List<String> TOPICS = List.of(
            Topics.DOMAINS,
            Topics.MISSIONS,
            Topics.MISSION_DEVICES,
            Topics.MISSIONS_STATUS,
            Topics.TEMPLATES,
            Topics.DEVICES,
            Topics.DEVICES_STATUS,
            Topics.DEVICES_HEALTH,
            Topics.DEVICES_CONNECTION,
            Topics.REPLAYS,
            Topics.REPLAYS_STATUS,
            Topics.RECORDINGS,
            Topics.ALARMS);

    /** Number of cached entries of the audit topic. */
    public static final int AUDITED = 1000;

    /** Number of changes from which a client can continue. */
    private static final int REMEMBERED = 10_000;

    private static final Pattern ID = Pattern.compile("([0-9a-f]{8})-([0-9]{1,18})");

    private final Map<String, Map<String, byte[]>> byTopic = new ConcurrentHashMap<>();
    private final Deque<Audited> audited = new ArrayDeque<>();
    private boolean auditedWhole;
    private volatile boolean complete;
    /** Of this process: positions of another one mean nothing. */
    private final String instance = UUID.randomUUID().toString().substring(0, 8);
    /** The changes after {@code forgotten}, in order. */
    private final Deque<Change> changes = new ArrayDeque<>();

    private long forgotten;
    private volatile long position;
    private volatile Listener listener;

    /** Called on the thread that reads the topics; must not block. */
    interface Listener {
        void changed(Change change);

        /** Called after all topics were read again. */
        void completed();
    }

    /** A change of a record. @param position increases by one with each */
    record Change(long position, String topic, String key) {}

    private record Audited(long offset, byte[] value) {}

    /**
     * Entries of the audit topic, the newest first.
     *
     * @param isWhole whether there are no older ones in the topic
     */
    public record AuditPage(List<AuditedEntry> entries, boolean isWhole) {}

    public record Entry(String key, ObjectNode value) {}

    /** Clears the view; it cannot be read until {@link #complete()}. */
    void clear() {
        complete = false;
        synchronized (changes) {
            changes.clear();
            forgotten = position;
        }
        TOPICS.forEach(topic -> byTopic.put(topic, new ConcurrentSkipListMap<>()));
        synchronized (audited) {
            audited.clear();
        }
    }

    /** @param value a JSON object; null removes it */
    void put(String topic, String key, byte[] value) {
        if (value == null) {
            byTopic.get(topic).remove(key);
        } else {
            byTopic.get(topic).put(key, value);
        }
        Change change = remember(topic, key);
        if (complete && listener != null) {
            listener.changed(change);
        }
    }

    /** While the topics are read, changes are not remembered: a record that was deleted meanwhile is not seen. */
    private Change remember(String topic, String key) {
        synchronized (changes) {
            Change change = new Change(position + 1, topic, key);
            position = change.position();
            if (complete) {
                changes.addLast(change);
            }
            if (!complete || changes.size() > REMEMBERED) {
                forgotten = complete ? changes.removeFirst().position() : position;
            }
            return change;
        }
    }

    /** The position of the last change. */
    long position() {
        return position;
    }

    /** Returns a position as the id of an event. */
    String id(long at) {
        return instance + "-" + at;
    }

    /** Returns the changes after an {@link #id}; empty if they are not all known. @param id may be null or invalid */
    Optional<Collection<Change>> changesSince(String id) {
        Matcher known = ID.matcher(id == null ? "" : id);
        if (!known.matches() || !known.group(1).equals(instance)) {
            return Optional.empty();
        }
        long since = Long.parseLong(known.group(2));
        synchronized (changes) {
            return since < forgotten || since > position
                    ? Optional.empty()
                    : Optional.of(changes.stream()
                            .filter(change -> change.position() > since)
                            .toList());
        }
    }

    /** Called before the first audit entry. @param isFirst whether it is the first of the topic */
    void auditFrom(boolean isFirst) {
        synchronized (audited) {
            auditedWhole = isFirst;
        }
    }

    /** @param offset of the entry in the topic, greater than those before */
    void audit(long offset, byte[] entry) {
        synchronized (audited) {
            audited.addFirst(new Audited(offset, entry));
            if (audited.size() > AUDITED) {
                audited.removeLast();
                auditedWhole = false;
            }
        }
    }

    void complete() {
        complete = true;
        if (listener != null) {
            listener.completed();
        }
    }

    /** Sets the listener; called once, before the first {@link #put}. */
    public void listen(Listener to) {
        listener = to;
    }

    public boolean isComplete() {
        return complete;
    }

    /** Returns a value. @throws ProblemException if the topics were not read yet */
    public Optional<ObjectNode> find(String topic, String key) {
        return Optional.ofNullable(read(topic).get(key)).map(StateView::parse);
    }

    /** Returns all values in the order of their keys. @throws ProblemException as {@link #find} */
    public Stream<ObjectNode> all(String topic) {
        return read(topic).values().stream().map(StateView::parse);
    }

    /** Returns all keys in order. @throws ProblemException as {@link #find} */
    public Stream<String> keys(String topic) {
        return read(topic).keySet().stream();
    }

    /** Returns all values with their keys, in order. @throws ProblemException as {@link #find} */
    public Stream<Entry> entries(String topic) {
        return read(topic).entrySet().stream().map(each -> new Entry(each.getKey(), parse(each.getValue())));
    }

    private Map<String, byte[]> read(String topic) {
        if (!complete) {
            throw ProblemException.notReady();
        }
        return byTopic.get(topic);
    }

    /** Returns the cached entries before a position. @throws ProblemException as {@link #find} */
    public AuditPage audited(long before) {
        if (!complete) {
            throw ProblemException.notReady();
        }
        List<Audited> entries;
        boolean isWhole;
        synchronized (audited) {
            entries = audited.stream().filter(each -> each.offset() < before).toList();
            isWhole = auditedWhole;
        }
        return new AuditPage(
                entries.stream()
                        .map(each -> new AuditedEntry(each.offset(), parse(each.value())))
                        .toList(),
                isWhole);
    }

    private static ObjectNode parse(byte[] value) {
        return (ObjectNode) NgsiJson.own(() -> NgsiJson.read(value));
    }
}
