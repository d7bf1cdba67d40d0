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

/** Missions in memory; one that is away cannot be read until it is back, {@code stuck} never answers. */
final class MemoryRecordings implements Recordings {
    private static final long serialVersionUID = 1L;

    private final transient Map<String, List<StoredEvent>> missions = new ConcurrentHashMap<>();
    private final transient AtomicInteger open = new AtomicInteger();
    private final transient AtomicInteger held = new AtomicInteger();
    private final transient Set<String> away = ConcurrentHashMap.newKeySet();
    private volatile boolean holding;

    /** Events of the entity {@code urn:x} at these times. */
    MemoryRecordings with(String mission, long... times) {
        missions.put(mission, new CopyOnWriteArrayList<>());
        add(mission, times);
        return this;
    }

    /** Later ones. */
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

    void setAway(String mission, boolean isAway) {
        if (isAway) {
            away.add(mission);
        } else {
            away.remove(mission);
        }
    }

    private void requireThere(String mission) throws RecordingException {
        if (away.contains(mission)) {
            throw new RecordingException("the store is away");
        }
    }

    /** Whether whoever begins to read a mission from its beginning does so until he is interrupted. */
    void hold(boolean isHolding) {
        holding = isHolding;
    }

    /** How many are held. */
    int held() {
        return held.get();
    }

    private void hold() throws RecordingException {
        held.incrementAndGet();
        try {
            new CountDownLatch(1).await();
        } catch (InterruptedException e) {
            throw RecordingInterruptedException.of(e);
        } finally {
            held.decrementAndGet();
        }
    }

    /** How many recordings are open. */
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
        requireThere(mission);
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
            requireThere(mission);
            if (holding && after.equals(Cursor.START)) {
                hold();
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
