package io.furrow.flink.time;

import java.time.Duration;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkOutputMultiplexer;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;

import static org.assertj.core.api.Assertions.assertThat;

/** Three partitions of a replay, combined as Flink combines them; out-of-orderness 2 s, idle after 10 s. */
class ReplayWatermarksTest {
    private static final long BOUND = 2_000;
    private static final long IDLE = 10_000;
    private static final long HOUR = 3_600_000;

    private long clock = 500;
    private long reached = Long.MIN_VALUE;
    private final ReplayProgress progress = new ReplayProgress(() -> clock, IDLE / 10);
    private final WatermarkOutputMultiplexer combined = new WatermarkOutputMultiplexer(new Reached());
    private final TestPartition one = partition("one");
    private final TestPartition other = partition("other");
    private final TestPartition empty = partition("empty");

    @Test
    void waitForAPartitionThatHasNothingForTheIdleTimeoutOnly() {
        read(one, 0, 50_000);
        read(other, 0, 50_000);
        assertThat(afterwards(IDLE - 1)).isEqualTo(Long.MIN_VALUE);
        assertThat(afterwards(1)).isEqualTo(50_000 - BOUND - 1);
    }

    @Test
    void waitForTheOtherPartitionsHoweverLateTheReplayBegins() {
        assertThat(afterwards(HOUR)).isEqualTo(Long.MIN_VALUE);
        read(one, 0, 20_000);
        read(one, 0, 40_000);
        assertThat(afterwards(IDLE - 1))
                .as("the others' first records are not late")
                .isEqualTo(Long.MIN_VALUE);

        read(other, 0, 20_000);
        assertThat(afterwards(1)).isEqualTo(20_000 - BOUND - 1);
    }

    @Test
    void leaveAPausedReplayWhereItIs() {
        read(one, 0, 50_000);
        read(other, 0, 40_000);
        assertThat(afterwards(HOUR)).isEqualTo(40_000 - BOUND - 1);

        read(one, 0, 51_000);
        assertThat(afterwards(HOUR)).as("the other's next record is not late").isEqualTo(40_000 - BOUND - 1);

        read(other, 0, 40_500);
        assertThat(afterwards(0)).isEqualTo(40_500 - BOUND - 1);
    }

    @Test
    void goOnWithoutAPartitionThatFellSilentWhileOthersHadRecords() {
        read(other, 0, 40_000);
        for (long time = 40_000; time <= 60_000; time += 1_000) {
            read(one, 0, time);
            afterwards(1_000);
        }
        assertThat(reached).isGreaterThan(50_000);

        read(other, 0, 60_000);
        assertThat(reached).as("in the order of the replay, so in time").isLessThan(60_000);
    }

    @Test
    void beginAnewWithEachEpoch() {
        for (TestPartition partition : List.of(one, other, empty)) {
            read(partition, 0, 50_000);
        }
        read(one, 1, 20_000);
        assertThat(afterwards(0))
                .as("until the other partitions are there, too")
                .isEqualTo(50_000 - BOUND - 1);

        read(other, 1, 20_000);
        read(empty, 1, 20_000);
        assertThat(afterwards(0)).isEqualTo(Epochs.SPAN + 20_000 - BOUND - 1);
    }

    @Test
    void bringTheFormerEpochToItsEndBeforeTheNext() {
        empty.idle();
        other.idle();
        read(one, 0, 50_000);
        assertThat(reached).as("before the next periodic watermark").isEqualTo(Long.MIN_VALUE);
        read(one, 1, 20_000);
        assertThat(reached).isEqualTo(50_000 - BOUND - 1);
    }

    @Test
    void closeAnEpochWithItsEnd() {
        read(one, 0, 50_000);
        read(other, 0, 40_000);
        end(one, 0, 50_000);
        end(other, 0, 50_000);
        assertThat(afterwards(IDLE)).isEqualTo(Epochs.SPAN - 1);
        read(one, 1, 0);
        read(other, 1, 0);
        assertThat(afterwards(0))
                .as("the first instant of the next is not late")
                .isEqualTo(Epochs.SPAN - 1);
    }

    @Test
    void waitForTheOtherPartitionsHoweverLongAfterItsEndAnEpochIsFollowed() {
        end(one, 0, 50_000);
        end(other, 0, 50_000);
        end(empty, 0, 50_000);
        assertThat(afterwards(HOUR)).isEqualTo(Epochs.SPAN - 1);
        read(one, 1, 20_000);
        read(one, 1, 40_000);
        assertThat(afterwards(IDLE / 10))
                .as("the others' first records are not late")
                .isEqualTo(Epochs.SPAN - 1);

        read(other, 1, 20_000);
        read(empty, 1, 30_000);
        assertThat(afterwards(0)).isEqualTo(Epochs.SPAN + 20_000 - BOUND - 1);
    }

    @Test
    void waitForThePartitionsThatDoNotEndForTheIdleTimeoutOnly() {
        end(empty, 0, 50_000);
        read(one, 0, 50_000);
        read(other, 0, 40_000);
        end(one, 0, 50_000);
        assertThat(afterwards(IDLE - 1)).isEqualTo(40_000 - BOUND - 1);
        assertThat(afterwards(1)).isEqualTo(Epochs.SPAN - 1);
    }

    @Test
    void passOverWhatTellsNoTime() {
        empty.idle();
        other.idle();
        read(one, 0, 50_000);
        one.read(record(70_000, Map.of(HeaderNames.REPLAY_EPOCH, "next")), 70_000);
        assertThat(afterwards(0)).isEqualTo(50_000 - BOUND - 1);
    }

    private long afterwards(long millis) {
        clock += millis;
        one.emit();
        other.emit();
        empty.emit();
        combined.onPeriodicEmit();
        return reached;
    }

    private static TopicRecord record(long timestamp, Map<String, String> headers) {
        return TopicRecord.of("data.hoeing.replay.0a1b2c3d", timestamp, "r", new byte[0], headers);
    }

    private TestPartition partition(String name) {
        var watermarks = new ReplayWatermarks(Duration.ofMillis(BOUND), Duration.ofMillis(IDLE), progress);
        return new TestPartition(name, watermarks, combined);
    }

    private static void read(TestPartition partition, long epoch, long time) {
        Map<String, String> headers = Map.of(HeaderNames.REPLAY_EPOCH, Long.toString(epoch));
        partition.read(record(time, headers), epoch * Epochs.SPAN + time);
    }

    private static void end(TestPartition partition, long epoch, long time) {
        Map<String, String> headers =
                Map.of(HeaderNames.REPLAY_EPOCH, Long.toString(epoch), HeaderNames.REPLAY_KIND, "end");
        partition.read(record(time, headers), epoch * Epochs.SPAN + time);
    }

    private final class Reached implements WatermarkOutput {
        @Override
        public void emitWatermark(Watermark watermark) {
            reached = watermark.getTimestamp();
        }

        @Override
        public void markIdle() {}

        @Override
        public void markActive() {}
    }
}
