package io.furrow.bench.load;

import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.LongStream;
import java.util.stream.Stream;

import org.HdrHistogram.Histogram;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.header.Headers;

import io.furrow.bench.frame.Figures;
import io.furrow.model.event.HeaderNames;

/** The distinct events that have arrived: the times of their passage, and which were repeated or out of order. */
final class Arrivals {
    private static final long MAX_MS = 3_600_000;
    private static final int DIGITS = 3;
    private static final long STEP_MS = 100;

    private final Set<String> ids = new HashSet<>();
    private final List<Passage> passages = new ArrayList<>();
    private final Map<String, Long> newest = new HashMap<>();
    private final Map<String, Long> newestAtSource = new HashMap<>();
    private long repeats;
    private long reordered;
    private long reorderedAfterSource;

    /** The times at which the device sent an event, and the source, ingest and the reader had it, epoch ms. */
    record Passage(long device, long source, long ingest, long reader) {}

    /** An interval in which events were sent, epoch ms. */
    record Interval(long from, long to) {
        private boolean contains(long millis) {
            return millis >= from && millis < to;
        }
    }

    /** Must be called as soon as they arrive. */
    synchronized void add(ConsumerRecords<byte[], byte[]> records) {
        long now = System.currentTimeMillis();
        records.forEach(record -> add(new String(record.key(), StandardCharsets.UTF_8), record.headers(), now));
    }

    /** @param entity whose messages should arrive in the order in which they were sent */
    private void add(String entity, Headers headers, long now) {
        if (!ids.add(text(headers, HeaderNames.CE_ID))) {
            repeats++;
            return;
        }
        long device = stamp(headers, HeaderNames.TS_DEVICE);
        long source = stamp(headers, HeaderNames.TS_SOURCE);
        passages.add(new Passage(device, source, stamp(headers, HeaderNames.TS_INGEST), now));
        reordered += newest.merge(entity, device, Math::max) > device ? 1 : 0;
        reorderedAfterSource += newestAtSource.merge(entity, source, Math::max) > source ? 1 : 0;
    }

    synchronized long distinct() {
        return passages.size();
    }

    synchronized long repeats() {
        return repeats;
    }

    /** Number of events that arrived after a later one of the same entity, by time of sending. */
    synchronized long reordered() {
        return reordered;
    }

    /** The same by time of receipt at the source. */
    synchronized long reorderedAfterSource() {
        return reorderedAfterSource;
    }

    /** Delays of a hop, in milliseconds, for the events sent in an interval. */
    synchronized Histogram delays(Hop hop, Interval sent) {
        Histogram delays = new Histogram(MAX_MS, DIGITS);
        // A machine's clock may be set back by a millisecond between two timestamps.
        passages.stream()
                .filter(passage -> sent.contains(passage.device))
                .forEach(passage -> delays.recordValue(Math.min(MAX_MS, Math.max(0, hop.delay(passage)))));
        return delays;
    }

    synchronized List<LoadSecond> seconds() {
        return seconds(passages);
    }

    /** Counts of events at each point per second, and the mean delays of those sent in it. */
    static List<LoadSecond> seconds(List<Passage> passages) {
        Map<Long, long[]> counts = new TreeMap<>();
        Map<Long, long[]> sums = new HashMap<>();
        for (Passage each : passages) {
            long[] stamps = {each.device, each.source, each.ingest, each.reader};
            long[] sum = sums.computeIfAbsent(each.device / 1000, none -> new long[3]);
            for (int place = 0; place < stamps.length; place++) {
                counts.computeIfAbsent(stamps[place] / 1000, none -> new long[4])[place]++;
                if (place > 0) {
                    sum[place - 1] += stamps[place] - stamps[place - 1];
                }
            }
        }
        List<LoadSecond> seconds = new ArrayList<>();
        counts.forEach((second, count) -> {
            List<Double> means = LongStream.of(sums.getOrDefault(second, new long[0]))
                    .mapToObj(sum -> sum / (double) count[0])
                    .toList();
            long first = counts.keySet().iterator().next();
            seconds.add(new LoadSecond(second - first, count[0], count[1], count[2], count[3], means));
        });
        return seconds;
    }

    synchronized double arrivedPerSecond(Interval interval) {
        long arrived = passages.stream()
                .filter(passage -> interval.contains(passage.reader))
                .count();
        return arrived * 1000.0 / (interval.to - interval.from);
    }

    /** Adds a row for the events sent in an interval. @return p99 of their delays from device to reader, ms */
    long addTo(Figures figures, String title, Interval interval) {
        Histogram delays = delays(Hop.END_TO_END, interval);
        figures.add(
                "rate", title,
                "sent/s", delays.getTotalCount() * 1000.0 / (interval.to - interval.from),
                "arrived/s", arrivedPerSecond(interval),
                "p50 ms", delays.getValueAtPercentile(50),
                "p99 ms", delays.getValueAtPercentile(99),
                "waiting", waiting(interval.to));
        return delays.getValueAtPercentile(99);
    }

    /** Number of messages in flight at an instant. */
    synchronized long waiting(long at) {
        return passages.stream()
                .filter(passage -> passage.device <= at && passage.reader > at)
                .count();
    }

    long mostWaiting(Interval interval) {
        return Stream.iterate(interval.from, at -> at <= interval.to, at -> at + STEP_MS)
                .mapToLong(this::waiting)
                .max()
                .orElse(0);
    }

    private static long stamp(Headers headers, String name) {
        return Long.parseLong(text(headers, name));
    }

    private static String text(Headers headers, String name) {
        Header header = headers.lastHeader(name);
        if (header == null) {
            throw new IllegalStateException("a record without the header " + name);
        }
        return new String(header.value(), StandardCharsets.UTF_8);
    }
}
