package io.furrow.bench.load;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import org.HdrHistogram.Histogram;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;

import io.furrow.bench.frame.Figures;
import io.furrow.model.event.HeaderNames;

/** When distinct events were sent and arrived, epoch ms. */
final class Passages {
    private final List<Passage> passages = new ArrayList<>();
    private final Set<String> ids = new HashSet<>();
    private long repeats;

    private record Passage(long device, long reader) {}

    /** A time in which a rate was sent. */
    record Interval(long from, long to) {
        private boolean contains(long millis) {
            return millis >= from && millis < to;
        }
    }

    /** To be called as soon as they are there. */
    synchronized void add(ConsumerRecords<byte[], byte[]> records) {
        long now = System.currentTimeMillis();
        for (ConsumerRecord<byte[], byte[]> record : records) {
            if (ids.add(Arrivals.text(record.headers(), HeaderNames.CE_ID))) {
                passages.add(new Passage(Arrivals.stamp(record.headers(), HeaderNames.TS_DEVICE), now));
            } else {
                repeats++;
            }
        }
    }

    synchronized long arrived() {
        return passages.size();
    }

    /** Arrivals of events that had arrived before. */
    synchronized long repeats() {
        return repeats;
    }

    synchronized double arrivedPerSecond(Interval interval) {
        return passages.stream()
                        .filter(passage -> interval.contains(passage.reader()))
                        .count()
                * 1000.0
                / (interval.to() - interval.from());
    }

    /** Adds a row of what was sent in a time. @return p99 of its delays from device to reader, ms */
    synchronized long addTo(Figures figures, String title, Interval interval) {
        Histogram delays = new Histogram(3_600_000, 3);
        passages.stream()
                .filter(passage -> interval.contains(passage.device()))
                .forEach(passage -> delays.recordValue(Math.max(0, passage.reader() - passage.device())));
        long p99 = delays.getValueAtPercentile(99);
        figures.add(
                "rate",
                title,
                "sent/s",
                delays.getTotalCount() * 1000.0 / (interval.to() - interval.from()),
                "arrived/s",
                arrivedPerSecond(interval),
                "p50 ms",
                delays.getValueAtPercentile(50),
                "p99 ms",
                p99,
                "waiting",
                waiting(interval.to()));
        return p99;
    }

    /** Messages on their way at an instant. */
    synchronized long waiting(long at) {
        return passages.stream()
                .filter(passage -> passage.device() <= at && passage.reader() > at)
                .count();
    }

    long mostWaiting(Interval interval) {
        long most = 0;
        for (long at = interval.from(); at <= interval.to(); at += 100) {
            most = Math.max(most, waiting(at));
        }
        return most;
    }
}
