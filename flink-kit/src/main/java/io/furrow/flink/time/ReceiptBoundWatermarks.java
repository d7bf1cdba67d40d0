package io.furrow.flink.time;

import java.io.Serializable;
import java.time.Duration;
import java.util.function.LongSupplier;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkGeneratorSupplier;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.metrics.Counter;

import io.furrow.flink.record.Receipt;
import io.furrow.flink.record.TopicRecord;

/**
 * Event time of one partition: its newest timestamp, behind by the out-of-orderness. A record counts as of its {@link Receipt} at the
 * latest, so that a device whose clock is ahead makes no other late; its own events wait until event time has come to
 * them. Nor does a source whose clock is ahead: where its stamps are later than the wall clock and the skew, and there alone, event time
 * depends on the wall clock; it comes to be ahead by the skew at most, and so little is lost when the clock is right again.
 * What is replayed has no receipt. A quiet partition holds up nothing; with the idle advance its event
 * time continues with the wall clock instead.
 */
public final class ReceiptBoundWatermarks implements WatermarkGenerator<TopicRecord> {
    private static final long NOTHING_YET = Long.MIN_VALUE;

    private final Receipt receipt;
    private final long bound;
    private final Quiet quiet;
    private final Clocks clocks;
    private final Counter ahead;
    private long newest = NOTHING_YET;
    private long newestSeen;

    /**
     * What becomes of a partition without records.
     *
     * @param after how long it has to be so
     * @param advance whether its event time continues with the clock; else it holds up nothing
     */
    public record Quiet(Duration after, boolean advance) implements Serializable {}

    /**
     * Both in milliseconds.
     *
     * @param wall since 1970
     * @param activity stands still while the job takes no records in, so that what it does not read does not look quiet
     */
    record Clocks(LongSupplier wall, LongSupplier activity) {}

    /**
     * @param ahead counts the records stamped later than their receipt by more than the out-of-orderness
     */
    ReceiptBoundWatermarks(Receipt receipt, Duration outOfOrderness, Quiet quiet, Clocks clocks, Counter ahead) {
        this.receipt = receipt;
        this.bound = outOfOrderness.toMillis();
        this.quiet = quiet;
        this.clocks = clocks;
        this.ahead = ahead;
        newestSeen = clocks.activity.getAsLong();
    }

    @Override
    public void onEvent(TopicRecord record, long timestamp, WatermarkOutput output) {
        newestSeen = clocks.activity.getAsLong();
        long received = receipt.of(record, timestamp, clocks.wall.getAsLong());
        newest = Math.max(newest, Math.min(timestamp, received));
        if (timestamp - bound > received) {
            ahead.inc();
        }
    }

    @Override
    public void onPeriodicEmit(WatermarkOutput output) {
        long quietFor = clocks.activity.getAsLong() - newestSeen - quiet.after.toMillis();
        if (quietFor < 0 && newest != NOTHING_YET) {
            output.emitWatermark(new Watermark(newest - bound - 1));
        } else if (quietFor >= 0 && quiet.advance && newest != NOTHING_YET) {
            output.emitWatermark(new Watermark(newest - bound - 1 + quietFor));
        } else if (quietFor >= 0) {
            output.markIdle();
        }
    }

    /** One for each partition; those of a subtask count together as {@code recordsAhead}. */
    public static final class Supplier implements WatermarkGeneratorSupplier<TopicRecord> {
        private static final long serialVersionUID = 1L;

        private final Receipt receipt;
        private final Duration outOfOrderness;
        private final Quiet quiet;
        private transient Counter ahead;

        public Supplier(Receipt receipt, Duration outOfOrderness, Quiet quiet) {
            this.receipt = receipt;
            this.outOfOrderness = outOfOrderness;
            this.quiet = quiet;
        }

        @Override
        public WatermarkGenerator<TopicRecord> createWatermarkGenerator(Context context) {
            if (ahead == null) {
                ahead = context.getMetricGroup().counter("recordsAhead");
            }
            Clocks clocks = new Clocks(System::currentTimeMillis, context.getInputActivityClock()::relativeTimeMillis);
            return new ReceiptBoundWatermarks(receipt, outOfOrderness, quiet, clocks, ahead);
        }
    }
}
