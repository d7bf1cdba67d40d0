package io.furrow.bench.notifications;

import java.time.Duration;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import java.util.concurrent.locks.LockSupport;
import java.util.function.LongConsumer;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;

import io.furrow.bench.http.NotificationRequest;

/** Checks which of the numbered notifications are in the topic, counts repeated ones, and stores a sample of the records. */
final class ArrivalCheck {
    private static final int SAMPLES = 2000;
    private static final Duration QUIET = Duration.ofSeconds(20);
    private static final Duration POLL_INTERVAL = Duration.ofMillis(100);

    private final long firstNumber;
    private final BitSet arrived = new BitSet();
    private final List<ConsumerRecord<byte[], byte[]>> samples = new ArrayList<>();
    private long distinct;
    private long repeats;
    private long lastNanos;

    /** @param firstNumber of this load; smaller numbers belong to an earlier one and are skipped */
    ArrivalCheck(long firstNumber) {
        this.firstNumber = firstNumber;
    }

    /** Must be called as soon as they arrive. */
    void add(ConsumerRecords<byte[], byte[]> records) {
        long now = System.nanoTime();
        records.forEach(record -> add(record, now));
    }

    /** @param nanos when the reader received it */
    synchronized void add(ConsumerRecord<byte[], byte[]> record, long nanos) {
        long number = NotificationRequest.numberIn(record.value()) - firstNumber;
        if (number < 0 || number > Integer.MAX_VALUE) {
            return;
        }
        if (arrived.get((int) number)) {
            repeats++;
            return;
        }
        arrived.set((int) number);
        distinct++;
        lastNanos = nanos;
        if (samples.size() < SAMPLES) {
            samples.add(record);
        }
    }

    synchronized long distinct() {
        return distinct;
    }

    synchronized long repeats() {
        return repeats;
    }

    /** When the newest first arrival was read, by {@link System#nanoTime}. */
    synchronized long lastNanos() {
        return lastNanos;
    }

    /** The number of these, counted from the first, that have not arrived. */
    synchronized long missing(BitSet acknowledged) {
        BitSet missing = (BitSet) acknowledged.clone();
        missing.andNot(arrived);
        return missing.cardinality();
    }

    /** Waits until all of these have arrived, or no record has for a while. @param progress receives the number of arrivals */
    void await(BitSet acknowledged, LongConsumer progress) {
        long seen = -1;
        long moved = System.nanoTime();
        while (missing(acknowledged) > 0 && System.nanoTime() - moved < QUIET.toNanos()) {
            if (distinct() != seen) {
                seen = distinct();
                moved = System.nanoTime();
                progress.accept(seen);
            }
            LockSupport.parkNanos(POLL_INTERVAL.toNanos());
        }
    }

    synchronized List<ConsumerRecord<byte[], byte[]>> samples() {
        return List.copyOf(samples);
    }
}
