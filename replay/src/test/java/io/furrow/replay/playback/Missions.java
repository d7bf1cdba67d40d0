package io.furrow.replay.playback;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.replay.record.EventEncoder;
import io.furrow.unchecked.Unchecked;

/** Generates recordings in memory. */
final class Missions {
    static final long TIME = 1_700_000_000_000L;

    private Missions() {}

    static StoredEvent event(String id, long time, String entity) {
        ObjectNode json =
                JsonNodeFactory.instance.objectNode().put("id", entity).put("type", "T");
        return new StoredEvent(id, time, entity, Map.of("ce_type", "ngsi.entity.changed"), json);
    }

    private static StoredEvent deletion(String id, long time, String entity) {
        return new StoredEvent(id, time, entity, Map.of("ce_type", "ngsi.entity.deleted"), null);
    }

    /** Returns ordered events of 1 to 200 devices, some reported late, at equal times, after gaps, or deletions. */
    static List<StoredEvent> random(Random random) {
        int devices = 1 + random.nextInt(random.nextBoolean() ? 5 : 200);
        int count = 1 + random.nextInt(300);
        List<StoredEvent> events = new ArrayList<>();
        long time = TIME;
        for (int i = 0; i < count; i++) {
            time += switch (random.nextInt(10)) {
                case 0 -> random.nextInt(60_000);
                case 1, 2, 3 -> 0;
                default -> random.nextInt(500);
            };
            long at = time - random.nextInt(200);
            String entity = "urn:d" + random.nextInt(devices);
            String id = "%08x-%d".formatted(random.nextInt(), i);
            events.add(random.nextInt(40) == 0 ? deletion(id, at, entity) : event(id, at, entity));
        }
        events.sort(Comparator.comparingLong(StoredEvent::time).thenComparing(StoredEvent::id));
        return events;
    }

    /** Returns the result of a request, with a page of random size. */
    static ReadResult answer(
            ReadRequest readRequest, List<StoredEvent> recording, DesiredReplay desired, Random random) {
        if (readRequest instanceof ReadRequest.Begin begin) {
            List<StoredEvent> primes = begin.primed() ? stateBefore(recording, begin.point()) : List.of();
            return new ReadResult.Primed(
                    begin.epoch(),
                    primes(primes, begin, desired),
                    ready(page(recording, begin.first(), random), desired, begin.epoch()));
        } else if (readRequest instanceof ReadRequest.Next next) {
            return new ReadResult.NextPage(
                    next.epoch(), ready(page(recording, next.after(), random), desired, next.epoch()));
        }
        return new ReadResult.Opened(readRequest.epoch(), span(recording));
    }

    static ReadyPage ready(EventPage eventPage, DesiredReplay desired, long epoch) {
        return Unchecked.get(() -> new EventEncoder(desired, epoch, record -> record).page(eventPage));
    }

    private static List<ReadyEvent> primes(
            List<StoredEvent> stateBefore, ReadRequest.Begin begin, DesiredReplay desired) {
        return Unchecked.get(
                () -> new EventEncoder(desired, begin.epoch(), record -> record).primes(stateBefore, begin.point()));
    }

    /**
     * Returns the result of a step back.
     *
     * @param devices empty for all
     */
    static ReadResult back(ReadRequest.Back back, List<StoredEvent> recording, List<String> devices) {
        List<Cursor> before = recording.stream()
                .filter(event -> devices.isEmpty() || devices.contains(event.entityId()))
                .map(Cursor::after)
                .filter(cursor -> cursor.compareTo(back.first()) > 0 && cursor.compareTo(back.from()) <= 0)
                .toList();
        int left = before.size() - (int) back.count();
        return new ReadResult.SteppedBack(back.epoch(), back.count(), left <= 0 ? back.first() : before.get(left - 1));
    }

    private static Optional<RecordingExtent> span(List<StoredEvent> recording) {
        return recording.isEmpty()
                ? Optional.empty()
                : Optional.of(new RecordingExtent(
                        recording.get(0).time(),
                        recording.get(recording.size() - 1).time()));
    }

    private static EventPage page(List<StoredEvent> recording, Cursor after, Random random) {
        List<StoredEvent> rest = recording.stream()
                .filter(event -> Cursor.after(event).compareTo(after) > 0)
                .toList();
        int size = Math.min(rest.size(), 1 + random.nextInt(40));
        List<StoredEvent> events = rest.subList(0, size);
        Cursor next = size == 0 ? after : Cursor.after(events.get(size - 1));
        return new EventPage(events, List.of(), next, size == rest.size());
    }

    /** Returns the newest event of each entity that existed before the point. */
    static List<StoredEvent> stateBefore(List<StoredEvent> recording, long point) {
        Map<String, StoredEvent> newest = new TreeMap<>();
        for (StoredEvent event : recording) {
            if (event.time() < point && event.entity() == null) {
                newest.remove(event.entityId());
            } else if (event.time() < point) {
                newest.put(event.entityId(), event);
            }
        }
        return List.copyOf(newest.values());
    }
}
