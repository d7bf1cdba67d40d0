package io.furrow.replay.record;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.internals.RecordHeader;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TextHeaders;
import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.replay.playback.ReadyEvent;
import io.furrow.replay.playback.ReadyPage;

/**
 * Encodes the events of an epoch as records of the replay's topic: the stored event with the headers of a replay. It
 * runs in the thread that reads, so that playing an event costs little. Equal headers of consecutive records are
 * shared. Used by one thread.
 */
public final class EventEncoder {
    private static final Comparator<StoredEvent> BY_ENTITY =
            Comparator.comparing(StoredEvent::entityId).thenComparing(StoredEvent::id);
    /** Headers that each record gets anew instead of the stored ones. */
    private static final Set<String> REPLACED = Set.of(
            HeaderNames.CE_ID,
            HeaderNames.CE_TIME,
            HeaderNames.CE_SPECVERSION,
            HeaderNames.ORIGIN,
            HeaderNames.TS_DEVICE,
            HeaderNames.REPLAY_ID,
            HeaderNames.REPLAY_EPOCH,
            HeaderNames.REPLAY_KIND,
            HeaderNames.REPLAY_TIME,
            HeaderNames.REPLAY_SEQUENCE,
            HeaderNames.REPLAY_OFFSET,
            HeaderNames.REPLAY_CE_ID);

    private static final Map<String, String> DEFAULTS = Map.of(
            HeaderNames.CE_SOURCE, ReplayRecords.SOURCE,
            HeaderNames.SERVICE, FiwareScope.DEFAULT.service(),
            HeaderNames.SERVICE_PATH, FiwareScope.DEFAULT.servicePath());

    private final DesiredReplay replay;
    private final long epoch;
    private final Set<String> devices;
    private final Limit limit;
    private final List<Header> constant;
    private final Map<String, Shared> newest = new HashMap<>();

    /** Returns the record, or a dead letter if the record is too large for its topic. */
    public interface Limit {
        TopicRecord writable(TopicRecord record) throws IOException, InterruptedException;
    }

    private record Shared(String text, Header header) {}

    /** @param replay determines the topic, the name and the devices */
    public EventEncoder(DesiredReplay replay, long epoch, Limit limit) {
        this.replay = replay;
        this.epoch = epoch;
        this.limit = limit;
        this.devices = Set.copyOf(replay.plan().devices());
        this.constant = List.of(
                header(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION),
                header(HeaderNames.ORIGIN, Origin.REPLAY.code()),
                header(HeaderNames.REPLAY_ID, replay.replay()),
                header(HeaderNames.REPLAY_EPOCH, Long.toString(epoch)));
    }

    /** Encodes the events of the replay's devices; events with an invalid time are skipped. */
    public ReadyPage page(EventPage eventPage) throws IOException, InterruptedException {
        long skipped =
                eventPage.skipped().stream().mapToLong(SkippedRecords::count).sum();
        List<StoredEvent> read = eventPage.events();
        List<ReadyEvent> events = new ArrayList<>(read.size());
        for (StoredEvent event : read) {
            if (event.time() < 0 || event.time() >= Epochs.SPAN) { // outside of the range of replay timestamps
                skipped++;
            } else if (isChosen(event)) {
                events.add(event(event));
            }
        }
        long span = read.isEmpty()
                ? 0
                : read.get(read.size() - 1).time() - read.get(0).time();
        return new ReadyPage(events, read.size(), span, skipped, eventPage.next(), eventPage.last());
    }

    private boolean isChosen(StoredEvent event) {
        return devices.isEmpty() || devices.contains(event.entityId());
    }

    public ReadyEvent event(StoredEvent event) throws IOException, InterruptedException {
        return ready(event, ReplayRecords.EVENT, event.time());
    }

    /**
     * Encodes the states of the replay's devices, sorted by entity.
     *
     * @param point epoch ms at which the epoch begins
     */
    public List<ReadyEvent> primes(Collection<StoredEvent> states, long point)
            throws IOException, InterruptedException {
        List<StoredEvent> sorted =
                states.stream().filter(this::isChosen).sorted(BY_ENTITY).toList();
        List<ReadyEvent> primes = new ArrayList<>(sorted.size());
        for (StoredEvent event : sorted) {
            primes.add(ready(event, ReplayRecords.PRIME, point));
        }
        return primes;
    }

    private ReadyEvent ready(StoredEvent event, String kind, long time) throws IOException, InterruptedException {
        Map<String, String> stored = event.headers();
        List<Header> headers = new ArrayList<>(stored.size() + REPLACED.size() + DEFAULTS.size());
        headers.addAll(constant);
        headers.add(shared(HeaderNames.REPLAY_KIND, kind));
        for (Map.Entry<String, String> one : stored.entrySet()) {
            if (!REPLACED.contains(one.getKey())) {
                headers.add(shared(one.getKey(), one.getValue()));
            }
        }
        DEFAULTS.forEach((name, text) -> {
            if (!stored.containsKey(name)) {
                headers.add(shared(name, text));
            }
        });
        boolean deleted = event.entity() == null;
        if (!stored.containsKey(HeaderNames.CE_TYPE)) {
            headers.add(shared(HeaderNames.CE_TYPE, deleted ? HeaderNames.TYPE_DELETED : HeaderNames.TYPE_CHANGED));
        }
        String eventTime = Instant.ofEpochMilli(event.time()).toString();
        headers.add(shared(HeaderNames.CE_TIME, eventTime));
        headers.add(shared(HeaderNames.TS_DEVICE, Long.toString(event.time())));
        String shownTime =
                time == event.time() ? eventTime : Instant.ofEpochMilli(time).toString();
        headers.add(shared(HeaderNames.REPLAY_TIME, shownTime));
        headers.add(header(HeaderNames.REPLAY_CE_ID, event.id()));
        headers.add(header(HeaderNames.CE_ID, EventId.ofReplay(event.id(), replay.replay(), epoch)));
        byte[] value = deleted ? null : NgsiJson.write(event.entity());
        TextHeaders texts = TextHeaders.NONE.plus(headers.toArray(Header[]::new));
        TopicRecord record = TopicRecord.of(replay.topic(), time, event.entityId(), value, texts);
        return new ReadyEvent(Cursor.after(event), limitSize(record));
    }

    /** Checks the size of the record with the longest numbers that it may get when it is played. */
    private TopicRecord limitSize(TopicRecord record) throws IOException, InterruptedException {
        TopicRecord longest = ReplayRecords.numbered(record, record.timestamp(), Long.MAX_VALUE, Long.MAX_VALUE);
        TopicRecord writable = limit.writable(longest);
        return writable == longest ? record : writable;
    }

    /** Reuses the header of the record before if its text is the same. */
    private Header shared(String name, String text) {
        Shared before = newest.get(name);
        if (before != null && before.text().equals(text)) {
            return before.header();
        }
        Header header = header(name, text);
        newest.put(name, new Shared(text, header));
        return header;
    }

    static Header header(String name, String text) {
        return new RecordHeader(name, text.getBytes(StandardCharsets.UTF_8));
    }
}
