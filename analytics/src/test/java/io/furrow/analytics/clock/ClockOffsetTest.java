package io.furrow.analytics.clock;

import java.util.Random;
import java.util.function.LongUnaryOperator;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** A device that reports once a second, and how its times are corrected. */
class ClockOffsetTest {
    private static final long START = 1_700_000_000_000L;
    private static final long SECOND = 1000;
    private static final long MINUTE = 60 * SECOND;

    private ClockOffset offset;
    private long now = START;

    @Test
    void learnsByHowMuchAClockIsBehind() {
        report(2 * MINUTE + 2 * SECOND, time -> time - 3000);
        assertThat(offset.millis()).as("not before a span is over").isZero();
        report(SECOND, time -> time - 3000);
        assertThat(offset.millis()).isEqualTo(3000);
        assertThat(offset.corrected(now - 3000, now)).isEqualTo(now);
    }

    @Test
    void learnsAtOnceThatAClockIsAhead() {
        report(3 * SECOND, time -> time + 5000);
        assertThat(offset.millis()).isEqualTo(-5000);
        assertThat(offset.corrected(now + 5000, now)).isEqualTo(now);
    }

    @Test
    void isNotMovedByWhatMessagesTake() {
        Random random = new Random(7);
        report(10 * MINUTE, time -> time - 500 - random.nextInt(4000));
        assertThat(offset.millis()).as("the quickest took 0.5 s").isZero();
        report(10 * MINUTE, time -> time - 5000 - random.nextInt(4000));
        assertThat(offset.millis()).isBetween(5000L, 5400L);
    }

    @Test
    void isNotMovedByTwoWrongTimes() {
        report(5 * MINUTE, time -> time - 3000);
        report(SECOND, time -> time + 400 * SECOND);
        report(SECOND, time -> time + 500 * SECOND);
        assertThat(offset.millis()).isEqualTo(3000);
    }

    @Test
    void isNotMovedByWhatAGatewaySendsAtOnce() {
        report(5 * MINUTE, time -> time);
        long from = now;
        now += 9 * MINUTE;
        for (long time = from; time < now; time += SECOND) { // within 110 s
            long received = now + (time - from) / 5;
            offset = offset.after(time, received);
            assertThat(offset.millis()).isZero();
        }
        now += 2 * MINUTE;
        report(10 * MINUTE, time -> time);
        assertThat(offset.millis()).isZero();
    }

    @Test
    void goesBackAtOnceWhereTheClockIsSet() {
        report(5 * MINUTE, time -> time - 60 * SECOND);
        assertThat(offset.millis()).isEqualTo(60 * SECOND);
        assertThat(offset.corrected(now, now))
                .as("nothing happens after its receipt")
                .isEqualTo(now);
        report(3 * SECOND, time -> time);
        assertThat(offset.millis()).isZero();
    }

    @Test
    void followsAClockThatDrifts() {
        report(30 * MINUTE, time -> time - 2000 - (time - START) / 1000);
        assertThat(offset.millis()).as("behind by 3.8 s").isBetween(3300L, 3800L);
    }

    @Test
    void correctsNoMoreThanTenMinutes() {
        report(5 * MINUTE, time -> time - 11 * MINUTE);
        assertThat(offset.millis()).isZero();
        assertThat(offset.corrected(now, now)).isEqualTo(now);
    }

    /** What the clock shows at each second, received in the same. */
    private void report(long duration, LongUnaryOperator clock) {
        for (long end = now + duration; now < end; now += SECOND) {
            long time = clock.applyAsLong(now);
            offset = offset == null ? ClockOffset.first(time, now) : offset.after(time, now);
        }
    }
}
