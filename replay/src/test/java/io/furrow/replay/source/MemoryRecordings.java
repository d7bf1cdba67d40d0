package io.furrow.replay.source;

import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.Recordings;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StoredEvent;

/** Missions in memory; reads of an unavailable one fail, opening {@code stuck} never returns. */
final class MemoryRecordings implements Recordings {
    private static final long serialVersionUID = 1L;

    private final transient Map<String, List<StoredEvent>> missions = new ConcurrentHashMap<>();
    private final transient AtomicInteger open = new AtomicInteger();
    private final transient AtomicInteger blocked = new AtomicInteger();
    private final transient Set<String> unavailable = ConcurrentHashMap.newKeySet();
    private volatile boolean blocking;

    /** Adds a mission with events of the entity {@code urn:x} at these times. */
    MemoryRecordings with(String mission, long... times) {
        missions.put(mission, new CopyOnWriteArrayList<>());
        add(mission, times);
        return this;
    }

    /** Adds later events. */
    void add(String mission, long... times) {
        List<StoredEvent> events = missions.get(mission);
        for (long time : times) {
            events.add(new StoredEvent(
                    mission + "-" + events.size(),
                    time,
                    "urn:x",
                    Map.of(),
                    JsonNodeFactory.instance.objectNode().put("id", "urn:x").put("type", "X")));
        }
    }

    void setUnavailable(String mission, boolean isUnavailable) {
        if (isUnavailable) {
            unavailable.add(mission);
        } else {
            unavailable.remove(mission);
        }
    }

    private void requireAvailable(String mission) throws RecordingException {
        if (unavailable.contains(mission)) {
            throw new RecordingException("the store is unavailable");
        }
    }

    /** @param isBlocking whether reads from a mission's beginning block until they are interrupted */
    void block(boolean isBlocking) {
        blocking = isBlocking;
    }

    /** Returns the number of blocked reads. */
    int blocked() {
        return blocked.get();
    }

    private void block() throws RecordingException {
        blocked.incrementAndGet();
        try {
            new CountDownLatch(1).await();
        } catch (InterruptedException e) {
            throw RecordingInterruptedException.of(e);
        } finally {
            blocked.decrementAndGet();
        }
    }

    /** Returns the number of open recordings. */
    int open() {
        return open.get();
    }

    @Override
    public Optional<Recording> open(String mission) throws RecordingException {
        if (mission.equals("stuck")) {
            synchronized (this) {
                try {
                    wait();
                } catch (InterruptedException e) {
                    Thread.currentThread().interrupt();
                }
            }
        }
        requireAvailable(mission);
        return Optional.ofNullable(missions.get(mission)).map(events -> new InMemory(mission, events));
    }

    private final class InMemory implements Recording {
        private final String mission;
        private final List<StoredEvent> events;

        InMemory(String mission, List<StoredEvent> events) {
            this.mission = mission;
            this.events = events;
            open.incrementAndGet();
        }

        @Override
        public Optional<RecordingExtent> span() {
            return events.isEmpty()
                    ? Optional.empty()
                    : Optional.of(new RecordingExtent(
                            events.get(0).time(), events.get(events.size() - 1).time()));
        }

        @Override
        public EventPage read(Cursor after, PageLimits limits) throws RecordingException {
            requireAvailable(mission);
            if (blocking && after.equals(Cursor.START)) {
                block();
            }
            List<StoredEvent> rest = events.stream()
                    .filter(event -> Cursor.after(event).compareTo(after) > 0)
                    .toList();
            List<StoredEvent> page = rest.subList(0, Math.min(limits.events(), rest.size()));
            List<SkippedRecords> skipped = after.equals(Cursor.START)
                    ? List.of(new SkippedRecords("two documents", "no _time", 2))
                    : List.of();
            Cursor next = page.isEmpty() ? after : Cursor.after(page.get(page.size() - 1));
            return new EventPage(page, skipped, next, page.size() == rest.size());
        }

        @Override
        public void close() {
            open.decrementAndGet();
        }
    }
}
