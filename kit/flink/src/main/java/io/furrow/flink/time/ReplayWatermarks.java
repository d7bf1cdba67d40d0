package io.furrow.flink.time;

import java.time.Duration;
import java.util.function.LongSupplier;

import org.apache.flink.api.common.eventtime.TimestampAssigner;
import org.apache.flink.api.common.eventtime.TimestampAssignerSupplier;
import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkGeneratorSupplier;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Event time of one partition of a replay, see {@link Epochs}: that of its newest record, less the out-of-orderness; after an
 * {@code end} the last instant of the epoch. A partition holds back nothing without a first record for the idle timeout, counted
 * from the first record of any, and afterwards without a record for as much time of reading ({@link ReplayProgress}), which stands
 * still while the replay is paused: otherwise its next record, after the pause, could be late. The furthest partition holds back
 * none and is never idle: if all were idle at once, event time would stop.
 */
public final class ReplayWatermarks implements WatermarkGenerator<TopicRecord> {
    private static final long NOTHING_YET = Long.MIN_VALUE;
    /** Share of the idle timeout. */
    private static final int PAUSE_SHARE = 10;

    private final long bound;
    private final long idleMillis;
    private final ReplayProgress replay;
    private long reached = NOTHING_YET;
    private final long since;
    private long newestRead;

    ReplayWatermarks(Duration outOfOrderness, Duration idleTimeout, ReplayProgress replay) {
        this.bound = outOfOrderness.toMillis();
        this.idleMillis = idleTimeout.toMillis();
        this.replay = replay;
        since = replay.clockMillis();
    }

    /** @param timestamp event time of the record */
    @Override
    public void onEvent(TopicRecord record, long timestamp, WatermarkOutput output) {
        boolean isEnd;
        try {
            Epochs.timeOf(record);
            isEnd = ReplayKind.of(record) == ReplayKind.END;
        } catch (UnreadableException e) { // another stage emits its dead letter
            return;
        }
        if (reached != NOTHING_YET && Epochs.of(timestamp) > Epochs.of(reached)) {
            output.emitWatermark(
                    new Watermark(reached)); // the end of the previous epoch, however soon this one follows
        }
        reached = Math.max(reached, isEnd ? Epochs.end(Epochs.of(timestamp)) : timestamp - bound - 1);
        replay.advance(timestamp, reached, isEnd);
        newestRead = replay.millis();
    }

    @Override
    public void onPeriodicEmit(WatermarkOutput output) {
        if (reached == NOTHING_YET) {
            if (replay.clockMillisSince(since) >= idleMillis) {
                output.markIdle();
            }
        } else if (replay.millis() - newestRead >= idleMillis && !replay.isFurthest(reached)) {
            output.markIdle();
        } else {
            output.emitWatermark(new Watermark(reached));
        }
    }

    /** Timestamps and watermarks of a replay that one subtask reads. */
    public static WatermarkStrategy<TopicRecord> strategy(Duration outOfOrderness, Duration idleTimeout) {
        TimestampAssignerSupplier<TopicRecord> timestamps = context -> new EventTime();
        return WatermarkStrategy.forGenerator(new Supplier(outOfOrderness, idleTimeout))
                .withTimestampAssigner(timestamps);
    }

    private static final class EventTime implements TimestampAssigner<TopicRecord> {
        @Override
        public long extractTimestamp(TopicRecord record, long stamped) {
            try {
                return Epochs.timeOf(record);
            } catch (UnreadableException e) { // another stage emits its dead letter
                return record.timestamp();
            }
        }
    }

    /** Creates a generator per partition; those of a subtask share their progress. */
    private static final class Supplier implements WatermarkGeneratorSupplier<TopicRecord> {
        private static final long serialVersionUID = 1L;

        private final Duration outOfOrderness;
        private final Duration idleTimeout;
        private transient ReplayProgress progress;

        Supplier(Duration outOfOrderness, Duration idleTimeout) {
            this.outOfOrderness = outOfOrderness;
            this.idleTimeout = idleTimeout;
        }

        @Override
        public WatermarkGenerator<TopicRecord> createWatermarkGenerator(Context context) {
            if (progress == null) {
                LongSupplier clock = context.getInputActivityClock()::relativeTimeMillis;
                progress = new ReplayProgress(clock, idleTimeout.toMillis() / PAUSE_SHARE);
            }
            return new ReplayWatermarks(outOfOrderness, idleTimeout, progress);
        }
    }
}
