package io.furrow.flink.time;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.metrics.SimpleCounter;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;

import static org.assertj.core.api.Assertions.assertThat;

/** Out-of-orderness 2 s, idle after 10 s, skew 10 s; the wall clock stands at 1,000 s. */
class ClockBoundedWatermarksTest {
    private static final long NOW = 1_000_000;
    private static final long BOUND = 2_000;
    private static final long SKEW = 10_000;

    private final SimpleCounter ahead = new SimpleCounter();
    private final List<Long> emitted = new ArrayList<>();
    private long activity = 7;
    private boolean idle;
    private ClockBoundedWatermarks watermarks = watermarks(false);

    @Test
    void followTheNewestTimestampBehindByTheOutOfOrderness() {
        assertThat(after(record(500_000, "499_000")))
                .as("no number is not a stamp")
                .isEqualTo(500_000 - BOUND - 1);
        assertThat(after(record(400_000, null))).isEqualTo(500_000 - BOUND - 1);
        assertThat(ahead.getCount()).isZero();
    }

    @Test
    void areNotDraggedByADeviceWhoseClockIsAhead() {
        assertThat(after(record(500_000, "500100"))).isEqualTo(500_000 - BOUND - 1);
        assertThat(after(record(4_000_000, "500200")))
                .as("as of its receipt, not as of the wall clock: the backlog of an hour stays in time")
                .isEqualTo(500_200 - BOUND - 1);
        assertThat(ahead.getCount()).isEqualTo(1);
        assertThat(after(record(501_900, "500300"))).isEqualTo(500_300 - BOUND - 1);
        assertThat(ahead.getCount()).as("within the out-of-orderness").isEqualTo(1);
    }

    @Test
    void takeTheWallClockForTheReceiptOfWhatNoSourceStamped() {
        assertThat(after(record(4_000_000, null))).isEqualTo(NOW - BOUND - 1);
        assertThat(ahead.getCount()).isEqualTo(1);
    }

    @Test
    void takeReplayedRecordsAtTheirWord() {
        TopicRecord replayed =
                record(4_000_000, "500000").with(HeaderNames.ORIGIN, "replay").to("data.hoeing.replay.0a1b2c3d");
        assertThat(after(replayed)).isEqualTo(4_000_000 - BOUND - 1);
        assertThat(ahead.getCount()).isZero();
    }

    @Test
    void believeNoOriginOfReplaysOnOtherTopics() {
        assertThat(after(record(4_000_000, "500000").with(HeaderNames.ORIGIN, "replay")))
                .isEqualTo(500_000 - BOUND - 1);
        assertThat(ahead.getCount()).isEqualTo(1);
    }

    @Test
    void areAheadOfTheWallClockByTheSkewAtMostWhateverTheSourceStamped() {
        assertThat(after(record(NOW + SKEW, Long.toString(NOW + SKEW))))
                .as("a clock may be wrong by that")
                .isEqualTo(NOW + SKEW - BOUND - 1);
        long wrong = NOW + 50 * 60_000;
        assertThat(after(record(wrong, Long.toString(wrong)))).isEqualTo(NOW + SKEW - BOUND - 1);
        assertThat(ahead.getCount()).isEqualTo(1);
        assertThat(after(record(wrong, Long.toString(Long.MAX_VALUE)))).isEqualTo(NOW + SKEW - BOUND - 1);
    }

    @Test
    void holdUpNothingWhereAPartitionIsQuiet() {
        after(record(500_000, null));
        activity += 10_000;
        watermarks.onPeriodicEmit(output());
        assertThat(idle).isTrue();
        assertThat(after(record(500_100, null))).as("awake again").isEqualTo(500_100 - BOUND - 1);
        assertThat(idle).isFalse();
    }

    @Test
    void goOnWithTheWallClockInAQuietPartitionWhereAskedTo() {
        watermarks = watermarks(true);
        activity += 10_000;
        watermarks.onPeriodicEmit(output());
        assertThat(idle).as("there is no event time to go on from").isTrue();
        after(record(500_000, null));
        activity += 10_500;
        watermarks.onPeriodicEmit(output());
        assertThat(emitted.get(emitted.size() - 1)).isEqualTo(500_000 - BOUND - 1 + 500);
    }

    private ClockBoundedWatermarks watermarks(boolean idleAdvance) {
        return new ClockBoundedWatermarks(
                new ReceiptTime(Duration.ofMillis(SKEW)),
                Duration.ofMillis(BOUND),
                new ClockBoundedWatermarks.Hold(Duration.ofSeconds(10), idleAdvance, Duration.ofMinutes(1)),
                new ClockBoundedWatermarks.Clocks(() -> NOW, () -> activity),
                new ClockBoundedWatermarks.Reader(ahead));
    }

    private long after(TopicRecord record) {
        watermarks.onEvent(record, record.timestamp(), output());
        watermarks.onPeriodicEmit(output());
        return emitted.get(emitted.size() - 1);
    }

    private static TopicRecord record(long timestamp, String received) {
        TopicRecord record = TopicRecord.of("data.raw", timestamp, "r", new byte[0], Map.of());
        return received == null ? record : record.with(HeaderNames.TS_SOURCE, received);
    }

    private WatermarkOutput output() {
        return new WatermarkOutput() {
            @Override
            public void emitWatermark(Watermark watermark) {
                emitted.add(watermark.getTimestamp());
                idle = false;
            }

            @Override
            public void markIdle() {
                idle = true;
            }

            @Override
            public void markActive() {
                idle = false;
            }
        };
    }
}
