package io.furrow.flink.time;

import java.time.Duration;
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
    private final Partition one = new Partition("one");
    private final Partition other = new Partition("other");
    private final Partition empty = new Partition("empty");

    @Test
    void waitForAPartitionThatHasNothingForTheIdleTimeoutOnly() {
        one.read(0, 50_000);
        other.read(0, 50_000);
        assertThat(afterwards(IDLE - 1)).isEqualTo(Long.MIN_VALUE);
        assertThat(afterwards(1)).isEqualTo(50_000 - BOUND - 1);
    }

    @Test
    void waitForTheOtherPartitionsHoweverLateTheReplayBegins() {
        assertThat(afterwards(HOUR)).isEqualTo(Long.MIN_VALUE);
        one.read(0, 20_000);
        one.read(0, 40_000);
        assertThat(afterwards(IDLE - 1))
                .as("the others' first records are not late")
                .isEqualTo(Long.MIN_VALUE);

        other.read(0, 20_000);
        assertThat(afterwards(1)).isEqualTo(20_000 - BOUND - 1);
    }

    @Test
    void leaveAPausedReplayWhereItIs() {
        one.read(0, 50_000);
        other.read(0, 40_000);
        assertThat(afterwards(HOUR)).isEqualTo(40_000 - BOUND - 1);

        one.read(0, 51_000);
        assertThat(afterwards(HOUR)).as("the other's next record is not late").isEqualTo(40_000 - BOUND - 1);

        other.read(0, 40_500);
        assertThat(afterwards(0)).isEqualTo(40_500 - BOUND - 1);
    }

    @Test
    void goOnWithoutAPartitionThatFellSilentWhileOthersHadRecords() {
        other.read(0, 40_000);
        for (long time = 40_000; time <= 60_000; time += 1_000) {
            one.read(0, time);
            afterwards(1_000);
        }
        assertThat(reached).isGreaterThan(50_000);

        other.read(0, 60_000);
        assertThat(reached).as("in the order of the replay, so in time").isLessThan(60_000);
    }

    @Test
    void beginAnewWithEachEpoch() {
        for (Partition partition : new Partition[] {one, other, empty}) {
            partition.read(0, 50_000);
        }
        one.read(1, 20_000);
        assertThat(afterwards(0))
                .as("until the other partitions are there, too")
                .isEqualTo(50_000 - BOUND - 1);

        other.read(1, 20_000);
        empty.read(1, 20_000);
        assertThat(afterwards(0)).isEqualTo(Epochs.SPAN + 20_000 - BOUND - 1);
    }

    @Test
    void bringTheFormerEpochToItsEndBeforeTheNext() {
        empty.idle();
        other.idle();
        one.read(0, 50_000);
        assertThat(reached).as("before the next periodic watermark").isEqualTo(Long.MIN_VALUE);
        one.read(1, 20_000);
        assertThat(reached).isEqualTo(50_000 - BOUND - 1);
    }

    @Test
    void closeAnEpochWithItsEnd() {
        one.read(0, 50_000);
        other.read(0, 40_000);
        one.end(0, 50_000);
        other.end(0, 50_000);
        assertThat(afterwards(IDLE)).isEqualTo(Epochs.SPAN - 1);
        one.read(1, 0);
        other.read(1, 0);
        assertThat(afterwards(0))
                .as("the first instant of the next is not late")
                .isEqualTo(Epochs.SPAN - 1);
    }

    @Test
    void waitForTheOtherPartitionsHoweverLongAfterItsEndAnEpochIsFollowed() {
        one.end(0, 50_000);
        other.end(0, 50_000);
        empty.end(0, 50_000);
        assertThat(afterwards(HOUR)).isEqualTo(Epochs.SPAN - 1);
        one.read(1, 20_000);
        one.read(1, 40_000);
        assertThat(afterwards(IDLE / 10))
                .as("the others' first records are not late")
                .isEqualTo(Epochs.SPAN - 1);

        other.read(1, 20_000);
        empty.read(1, 30_000);
        assertThat(afterwards(0)).isEqualTo(Epochs.SPAN + 20_000 - BOUND - 1);
    }

    @Test
    void waitForThePartitionsThatDoNotEndForTheIdleTimeoutOnly() {
        empty.end(0, 50_000);
        one.read(0, 50_000);
        other.read(0, 40_000);
        one.end(0, 50_000);
        assertThat(afterwards(IDLE - 1)).isEqualTo(40_000 - BOUND - 1);
        assertThat(afterwards(1)).isEqualTo(Epochs.SPAN - 1);
    }

    @Test
    void passOverWhatTellsNoTime() {
        empty.idle();
        other.idle();
        one.read(0, 50_000);
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

    private final class Partition {
        private final ReplayWatermarks watermarks =
                new ReplayWatermarks(Duration.ofMillis(BOUND), Duration.ofMillis(IDLE), progress);
        private final String name;

        Partition(String name) {
            this.name = name;
            combined.registerNewOutput(name, new WatermarkOutputMultiplexer.WatermarkUpdateListener() {
                @Override
                public void onWatermarkUpdate(long watermark) {}

                @Override
                public void onIdleUpdate(boolean idle) {}
            });
        }

        void read(long epoch, long time) {
            read(record(time, Map.of(HeaderNames.REPLAY_EPOCH, Long.toString(epoch))), epoch * Epochs.SPAN + time);
        }

        void end(long epoch, long time) {
            read(
                    record(
                            time,
                            Map.of(HeaderNames.REPLAY_EPOCH, Long.toString(epoch), HeaderNames.REPLAY_KIND, "end")),
                    epoch * Epochs.SPAN + time);
        }

        void read(TopicRecord record, long time) {
            watermarks.onEvent(record, time, combined.getImmediateOutput(name));
        }

        void idle() {
            combined.getImmediateOutput(name).markIdle();
        }

        void emit() {
            watermarks.onPeriodicEmit(combined.getDeferredOutput(name));
        }
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
