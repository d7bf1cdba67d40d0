package io.furrow.flink;

import java.io.Serializable;
import java.time.Duration;
import java.util.function.LongSupplier;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkGeneratorSupplier;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.metrics.Counter;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;

/**
 * Event time of one partition: its newest timestamp, behind by the out-of-orderness. A record counts as of its receipt at the
 * latest, so that a device whose clock is ahead makes no other late; its own events wait until event time has come to
 * them. The receipt is what the source stamped, {@code ts-source}, else the wall clock; with the stamp the same input gives
 * the same event time. What is replayed has no receipt. A quiet partition holds up nothing; with the idle advance its event
 * time goes on with the wall clock instead.
 */
final class ReceiptBoundWatermarks implements WatermarkGenerator<TopicRecord> {
    private static final long NOTHING_YET = Long.MIN_VALUE;

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
     * @param advance whether its event time goes on with the clock; else it holds up nothing
     */
    record Quiet(Duration after, boolean advance) implements Serializable {}

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
    ReceiptBoundWatermarks(Duration outOfOrderness, Quiet quiet, Clocks clocks, Counter ahead) {
        this.bound = outOfOrderness.toMillis();
        this.quiet = quiet;
        this.clocks = clocks;
        this.ahead = ahead;
        newestSeen = clocks.activity.getAsLong();
    }

    @Override
    public void onEvent(TopicRecord record, long timestamp, WatermarkOutput output) {
        newestSeen = clocks.activity.getAsLong();
        long receipt = receipt(record);
        newest = Math.max(newest, Math.min(timestamp, receipt));
        if (timestamp - bound > receipt) {
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

    private long receipt(TopicRecord record) {
        if (Origin.REPLAY.code().equals(record.headers().get(HeaderNames.ORIGIN))) {
            return Long.MAX_VALUE;
        }
        String stamp = record.headers().get(HeaderNames.TS_SOURCE);
        try {
            return stamp == null ? clocks.wall.getAsLong() : Long.parseLong(stamp);
        } catch (NumberFormatException e) { // a stranger's header
            return clocks.wall.getAsLong();
        }
    }

    /** One for each partition; those of a subtask count together as {@code records.ahead}. */
    static final class Supplier implements WatermarkGeneratorSupplier<TopicRecord> {
        private static final long serialVersionUID = 1L;

        private final Duration outOfOrderness;
        private final Quiet quiet;
        private transient Counter ahead;

        Supplier(Duration outOfOrderness, Quiet quiet) {
            this.outOfOrderness = outOfOrderness;
            this.quiet = quiet;
        }

        @Override
        public WatermarkGenerator<TopicRecord> createWatermarkGenerator(Context context) {
            if (ahead == null) {
                ahead = context.getMetricGroup().counter("records.ahead");
            }
            Clocks clocks = new Clocks(System::currentTimeMillis, context.getInputActivityClock()::relativeTimeMillis);
            return new ReceiptBoundWatermarks(outOfOrderness, quiet, clocks, ahead);
        }
    }
}
