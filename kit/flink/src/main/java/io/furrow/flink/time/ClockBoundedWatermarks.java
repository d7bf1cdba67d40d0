package io.furrow.flink.time;

import java.io.Serializable;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.LongSupplier;
import java.util.function.ToLongFunction;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkGeneratorSupplier;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Gauge;

import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;

/**
 * Generates the event time of one partition: its newest timestamp, less the out-of-orderness. A record counts as of its
 * {@link ReceiptTime} at the latest, so that a device whose clock is ahead makes no other's records late; its own are buffered until
 * event time reaches them. The same holds for a source whose clock is ahead: only where its stamps are later than the wall clock and the
 * skew, event time depends on the wall clock; it is then ahead by the skew at most, so that little is lost when the clock is corrected.
 * Replayed records have no receipt. A quiet partition holds back nothing; with the idle advance its event time continues with the wall
 * clock instead.
 *
 * <p>A device whose clock is behind does not hold back others either. The delay of a partition is that of its newest record relative to
 * its receipt; if none has been newer for the idle timeout, that of each record. A partition whose delay exceeds the least one of its
 * subtask by more than {@link Hold#maxBehind} counts as of its receipts, less that least delay. If the least delay itself exceeds the
 * limit, the whole subtask is active for its watermarks alone: they advance event time if no other subtask does.
 */
public final class ClockBoundedWatermarks implements WatermarkGenerator<TopicRecord> {
    private static final long NOTHING_YET = Long.MIN_VALUE;

    private final ReceiptTime receiptTime;
    private final long bound;
    private final Hold hold;
    private final Clocks clocks;
    private final Reader reader;
    private long newest = NOTHING_YET;
    private long newestSeen;
    /** The newest receipt, and that of the newest record. */
    private long received;

    private long newestReceived;
    private long delay;
    private long emitted = NOTHING_YET;

    /**
     * How long a partition holds back event time.
     *
     * @param idleTimeout without a record
     * @param advance whether event time then continues with the clock; otherwise the partition no longer holds it back
     * @param maxBehind how much the delay of its records may exceed that of others
     */
    public record Hold(Duration idleTimeout, boolean advance, Duration maxBehind) implements Serializable {}

    /**
     * Both in milliseconds.
     *
     * @param wall since 1970
     * @param activity stands still while the job reads no records, so that unread partitions do not seem quiet
     */
    record Clocks(LongSupplier wall, LongSupplier activity) {}

    /**
     * The shared state of a subtask's partitions.
     *
     * @param ahead counts records whose stamp is later than their receipt by more than the out-of-orderness
     */
    record Reader(Counter ahead, List<ClockBoundedWatermarks> partitions) {
        Reader(Counter ahead) {
            this(ahead, new CopyOnWriteArrayList<>()); // metrics read it
        }

        long leastDelay() {
            return least(partition -> partition.delay);
        }

        long slowest(long leastDelay) {
            return least(partition -> partition.time(leastDelay));
        }

        private long least(ToLongFunction<ClockBoundedWatermarks> value) {
            return partitions.stream()
                    .filter(ClockBoundedWatermarks::isHeard)
                    .mapToLong(value)
                    .min()
                    .orElseThrow();
        }

        int behind() {
            return (int) partitions.stream()
                    .filter(partition -> partition.delay > partition.hold.maxBehind.toMillis())
                    .count();
        }
    }

    ClockBoundedWatermarks(ReceiptTime receiptTime, Duration outOfOrderness, Hold hold, Clocks clocks, Reader reader) {
        this.receiptTime = receiptTime;
        this.bound = outOfOrderness.toMillis();
        this.hold = hold;
        this.clocks = clocks;
        this.reader = reader;
        newestSeen = clocks.activity.getAsLong();
        reader.partitions.add(this);
    }

    @Override
    public void onEvent(TopicRecord record, long timestamp, WatermarkOutput output) {
        newestSeen = clocks.activity.getAsLong();
        long now = clocks.wall.getAsLong();
        long at = receiptTime.of(record, timestamp, now);
        long time = Math.min(timestamp, at);
        boolean isBehind = at - time > hold.maxBehind.toMillis();
        if (!isBehind || receiptTime.stamp(record, now).isPresent()) {
            received = Math.max(received, at);
            see(time, at - time);
        } else {
            see(time, 0); // without a receipt
        }
        if (timestamp - bound > at) {
            reader.ahead.inc();
        }
    }

    private void see(long time, long behind) {
        boolean isNewest = time > newest;
        if (isNewest || behind < delay || received - newestReceived > hold.idleTimeout.toMillis()) {
            delay = behind;
        }
        if (isNewest) {
            newest = time;
            newestReceived = received;
        }
    }

    @Override
    public void onPeriodicEmit(WatermarkOutput output) {
        if (!isHeard()) {
            if (quietMillis() >= 0) {
                output.markIdle();
            }
            return;
        }
        long least = reader.leastDelay();
        long time = time(least);
        if (least <= hold.maxBehind.toMillis()) {
            output.emitWatermark(new Watermark(time - bound - 1));
            return;
        }
        if (time > emitted && time <= reader.slowest(least)) {
            emitted = time;
            output.emitWatermark(new Watermark(time - bound - 1));
        }
        output.markIdle();
    }

    /** Event time of the partition. */
    private long time(long leastDelay) {
        boolean isBehind = delay - leastDelay > hold.maxBehind.toMillis();
        return (isBehind ? Math.max(newest, received - leastDelay) : newest) + Math.max(0, quietMillis());
    }

    private boolean isHeard() {
        return newest != NOTHING_YET && (hold.advance || quietMillis() < 0);
    }

    /** Counted from the idle timeout on. */
    private long quietMillis() {
        return clocks.activity.getAsLong() - newestSeen - hold.idleTimeout.toMillis();
    }

    /** Creates a generator per partition; those of a subtask count together as {@code recordsAhead} and {@code partitionsBehind}. */
    public static final class Supplier implements WatermarkGeneratorSupplier<TopicRecord> {
        private static final long serialVersionUID = 1L;

        private final ReceiptTime receiptTime;
        private final Duration outOfOrderness;
        private final Hold hold;
        private transient Reader reader;

        public Supplier(ReceiptTime receiptTime, Duration outOfOrderness, Hold hold) {
            this.receiptTime = receiptTime;
            this.outOfOrderness = outOfOrderness;
            this.hold = hold;
        }

        @Override
        public WatermarkGenerator<TopicRecord> createWatermarkGenerator(Context context) {
            if (reader == null) {
                reader = new Reader(context.getMetricGroup().counter("recordsAhead"));
                context.getMetricGroup().gauge("partitionsBehind", (Gauge<Integer>) reader::behind);
            }
            Clocks clocks = new Clocks(System::currentTimeMillis, context.getInputActivityClock()::relativeTimeMillis);
            return new ClockBoundedWatermarks(receiptTime, outOfOrderness, hold, clocks, reader);
        }
    }
}
