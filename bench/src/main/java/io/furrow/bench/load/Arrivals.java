package io.furrow.bench.load;

import java.nio.charset.StandardCharsets;
import java.util.EnumMap;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.HdrHistogram.Histogram;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.Headers;

import io.furrow.model.event.HeaderNames;

/** What has arrived: distinct events, repeats, and the delay of each {@link Hop} of the first arrival of each event. */
final class Arrivals {
    private static final long MAX_MS = 3_600_000;
    private static final int DIGITS = 3;

    private final Set<String> ids = new HashSet<>();
    private final Map<Hop, Histogram> delays = new EnumMap<>(Hop.class);
    private final Timeline timeline = new Timeline();
    private final Map<String, Long> newest = new HashMap<>();
    private final Map<String, Long> newestAtSource = new HashMap<>();
    private final long notBefore;
    private long repeats;
    private long reordered;
    private long reorderedAfterSource;

    /** @param notBefore what was sent earlier counts, but its delays do not, epoch ms */
    Arrivals(long notBefore) {
        this.notBefore = notBefore;
        for (Hop hop : Hop.values()) {
            delays.put(hop, new Histogram(MAX_MS, DIGITS));
        }
    }

    /** To be called as soon as they are there. */
    void add(ConsumerRecords<byte[], byte[]> records) {
        long now = System.currentTimeMillis();
        records.forEach(record -> add(new String(record.key(), StandardCharsets.UTF_8), record.headers(), now));
    }

    /**
     * @param entity whose messages are to come in the order in which they were sent
     * @param now when the reader had the record, epoch ms
     */
    synchronized void add(String entity, Headers headers, long now) {
        if (!ids.add(text(headers, HeaderNames.CE_ID))) {
            repeats++;
            return;
        }
        long device = stamp(headers, HeaderNames.TS_DEVICE);
        long source = stamp(headers, HeaderNames.TS_SOURCE);
        long ingest = stamp(headers, HeaderNames.TS_INGEST);
        if (device >= notBefore) {
            record(Hop.DEVICE_TO_SOURCE, source - device);
            record(Hop.SOURCE_TO_INGEST, ingest - source);
            record(Hop.INGEST_TO_READER, now - ingest);
            record(Hop.SOURCE_TO_READER, now - source);
            record(Hop.END_TO_END, now - device);
        }
        timeline.add(device, source, ingest, now);
        if (newest.merge(entity, device, Math::max) > device) {
            reordered++;
        }
        if (newestAtSource.merge(entity, source, Math::max) > source) {
            reorderedAfterSource++;
        }
    }

    synchronized long distinct() {
        return ids.size();
    }

    synchronized long repeats() {
        return repeats;
    }

    /** Events that came after one of the same entity that was sent later. */
    synchronized long reordered() {
        return reordered;
    }

    /** Events that came after one of the same entity that the source had later. */
    synchronized long reorderedAfterSource() {
        return reorderedAfterSource;
    }

    synchronized List<LoadSecond> seconds() {
        return timeline.seconds();
    }

    /** A copy that no longer changes. */
    synchronized Histogram delays(Hop hop) {
        return delays.get(hop).copy();
    }

    /** The clock of one machine may be set back by a millisecond between two stamps. */
    private void record(Hop hop, long millis) {
        delays.get(hop).recordValue(Math.min(MAX_MS, Math.max(0, millis)));
    }

    static long stamp(Headers headers, String name) {
        return Long.parseLong(text(headers, name));
    }

    static String text(Headers headers, String name) {
        Header header = headers.lastHeader(name);
        if (header == null) {
            throw new IllegalStateException("a record without the header " + name);
        }
        return new String(header.value(), StandardCharsets.UTF_8);
    }
}
