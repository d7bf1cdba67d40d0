package io.furrow.flink.time;

import java.time.Duration;
import java.util.Map;
import java.util.Random;
import java.util.function.LongUnaryOperator;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkOutputMultiplexer;
import org.apache.flink.metrics.SimpleCounter;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * Partitions of one subtask, combined as Flink combines them: out-of-orderness 2 s, idle after 10 s, at most a minute behind the
 * others. A partition has a record each second, received at once.
 */
class DelayedPartitionsTest {
    private static final long START = 1_700_000_000_000L;
    private static final long SECOND = 1_000;
    private static final long MINUTE = 60 * SECOND;
    private static final long HOUR = 60 * MINUTE;
    private static final long BEHIND_LIVE = 5 * SECOND;
    private static final LongUnaryOperator RIGHT = now -> now;
    private static final LongUnaryOperator SLOW = now -> now - 2 * HOUR;

    private long now = START;
    private long reached = Long.MIN_VALUE;
    private boolean idle;
    private final ClockBoundedWatermarks.Reader reader = new ClockBoundedWatermarks.Reader(new SimpleCounter());
    private final WatermarkOutputMultiplexer combined = new WatermarkOutputMultiplexer(new Reached());
    private final TestPartition one = partition("one");
    private final TestPartition other = partition("other");

    @Test
    void areNotWaitedForWhereTheOnlyClockIsTwoHoursBehind() {
        for (long clock : new long[] {now - 2 * HOUR, 0, HOUR}) {
            report(10 * MINUTE, RIGHT, time -> clock + time - START);
            assertThat(now - reached).isLessThan(BEHIND_LIVE);
        }
    }

    @Test
    void areNotWaitedForWhereItsTimeStandsStill() {
        report(10 * MINUTE, RIGHT, time -> 0);
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
        assertThat(reader.behind()).isEqualTo(1);
    }

    @Test
    void areNoLongerWaitedForOnceAClockIsSetBack() {
        report(MINUTE, RIGHT, RIGHT);
        report(15 * SECOND, RIGHT, SLOW);
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
        report(3 * HOUR, RIGHT, SLOW);
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
        report(MINUTE, RIGHT, RIGHT);
        assertThat(reader.behind()).isZero();
    }

    @Test
    void areNoLongerWaitedForOnceTheirOtherDevicesAreOff() {
        read(other, RIGHT.applyAsLong(now), now);
        report(2 * SECOND, RIGHT, time -> time - 30 * MINUTE);
        read(other, now, now);
        report(15 * SECOND, RIGHT, time -> time - 30 * MINUTE);
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
        report(HOUR, RIGHT, time -> time - 30 * MINUTE);
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
    }

    @Test
    void areWaitedForAMinuteAtMostWhileAClockLosesTenMinutesAnHour() {
        for (int minute = 0; minute < 120; minute++) {
            report(MINUTE, RIGHT, time -> time - (time - START) / 6);
            assertThat(now - reached).isLessThan(MINUTE + BEHIND_LIVE);
        }
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
    }

    @Test
    void goByTheRightTimesOfAClockThatIsWrongNowAndThen() {
        Random random = new Random(3);
        report(HOUR, RIGHT, time -> random.nextInt(3) == 0 ? time : time - 2 * HOUR);
        report(4 * SECOND, time -> time + 10 * SECOND, RIGHT);
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
    }

    @Test
    void waitForEachOtherWhereAllClocksAreEquallyWrong() {
        report(10 * MINUTE, SLOW, time -> time - 2 * HOUR - 20 * SECOND);
        assertThat(now - reached).isBetween(2 * HOUR + 20 * SECOND, 2 * HOUR + 20 * SECOND + BEHIND_LIVE);
        assertThat(idle).as("holds up no other subtask").isTrue();

        report(MINUTE, SLOW, time -> 0);
        assertThat(now - reached).as("one that is further behind still").isBetween(2 * HOUR, 2 * HOUR + BEHIND_LIVE);

        report(MINUTE, SLOW, RIGHT);
        assertThat(now - reached).as("the one that is right").isLessThan(BEHIND_LIVE);
        assertThat(idle).isFalse();
    }

    @Test
    void goOnWithoutTheOthersWhereOnlyASlowClockStillReports() {
        report(MINUTE, RIGHT, SLOW);
        report(3 * HOUR, null, SLOW);
        assertThat(now - reached).isBetween(2 * HOUR, 2 * HOUR + BEHIND_LIVE);
        report(15 * SECOND, RIGHT, SLOW);
        assertThat(now - reached).isLessThan(BEHIND_LIVE);
    }

    @Test
    void waitForABacklogWhateverItsAge() {
        read(one, now, now);
        for (long time = now - 5 * HOUR; time < now; time += 10 * SECOND) {
            read(other, time, time);
            emit();
            assertThat(reached).isLessThan(time);
        }
    }

    @Test
    void keepTheirPlaceInABacklogWhileOnlyASlowClockReported() {
        read(one, now, now);
        for (long received = now - 5 * HOUR; received < now - HOUR; received += 10 * SECOND) {
            read(other, SLOW.applyAsLong(received), received);
            emit();
            assertThat(reached).as("what comes next is on time").isLessThan(received);
        }
        read(other, now - HOUR, now - HOUR);
        emit();
        assertThat(now - reached).isBetween(HOUR, HOUR + BEHIND_LIVE);
    }

    @Test
    void areNotWaitedForWhileAGatewaySendsWhatItStored() {
        report(MINUTE, RIGHT, RIGHT);
        long stored = now;
        report(HOUR, RIGHT, null);
        for (long time = stored; time < stored + HOUR - 2 * MINUTE; time += 50 * SECOND) {
            long buffered = time;
            report(SECOND, RIGHT, any -> buffered);
            assertThat(now - reached).isLessThan(BEHIND_LIVE);
        }
    }

    @Test
    void areWaitedForWhereNoReceiptIsKnown() {
        report(10 * SECOND, RIGHT, null);
        for (long time = START - 3 * HOUR; time < START - HOUR; time += MINUTE) {
            other.read(record(time, Map.of()), time);
            emit();
            assertThat(reached).isLessThan(time);
        }
    }

    private void report(long duration, LongUnaryOperator clock, LongUnaryOperator otherClock) {
        for (long end = now + duration; now < end; now += SECOND) {
            if (clock != null) {
                read(one, clock.applyAsLong(now), now);
            }
            if (otherClock != null) {
                read(other, otherClock.applyAsLong(now), now);
            }
            emit();
        }
    }

    private void emit() {
        one.emit();
        other.emit();
        combined.onPeriodicEmit();
    }

    private static TopicRecord record(long time, Map<String, String> headers) {
        return TopicRecord.of("data.raw", time, "r", new byte[0], headers);
    }

    private TestPartition partition(String name) {
        ClockBoundedWatermarks watermarks = new ClockBoundedWatermarks(
                new ReceiptTime(Duration.ofSeconds(10)),
                Duration.ofSeconds(2),
                new ClockBoundedWatermarks.Hold(Duration.ofSeconds(10), false, Duration.ofMinutes(1)),
                new ClockBoundedWatermarks.Clocks(() -> now, () -> now),
                reader);
        return new TestPartition(name, watermarks, combined);
    }

    private static void read(TestPartition partition, long time, long received) {
        partition.read(record(time, Map.of(HeaderNames.TS_SOURCE, Long.toString(received))), time);
    }

    private final class Reached implements WatermarkOutput {
        @Override
        public void emitWatermark(Watermark watermark) {
            reached = Math.max(reached, watermark.getTimestamp());
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
    }
}
