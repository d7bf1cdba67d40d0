package io.furrow.analytics.temperature.suspect;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.temperature.Farm;
import io.furrow.flink.time.KeyedLatenessOperator;

import static org.assertj.core.api.Assertions.assertThat;

/** Reports after three windows; windows are a second long, so that window n ends at (n + 1) seconds. */
class TrackSuspectsTest {
    private static final Duration MEMORY = Duration.ofSeconds(10);

    private KeyedOneInputStreamOperatorTestHarness<String, Verdict, SuspectDevice> operator;

    /** Before the last restart. */
    private final List<SuspectDevice> reported = new ArrayList<>();

    @BeforeEach
    void open() throws Exception {
        operator = create();
        operator.open();
    }

    @AfterEach
    void close() throws Exception {
        operator.close();
    }

    @Test
    void reportsADeviceOnceThatStaysSuspect() throws Exception {
        for (int window = 0; window < 7; window++) {
            suspect(window);
            pass(window);
            assertThat(operator.extractOutputValues()).as("window " + window).hasSize(window < 2 ? 0 : 1);
        }

        assertThat(operator.extractOutputValues()).containsExactly(new SuspectDevice(verdict("north", true, 2), 3, 0));
    }

    @Test
    void followsDevicesOfOneIdAndTwoTypesEach() throws Exception {
        for (int window = 0; window < 5; window++) {
            suspect(window);
            operator.processElement(verdict("Station", "north", window > 1, window), window);
            pass(window);
            restart();
        }

        assertThat(reported)
                .containsExactly(
                        new SuspectDevice(verdict("north", true, 2), 3, 0),
                        new SuspectDevice(verdict("Station", "north", true, 4), 3, 2_000));
    }

    @Test
    void startsAnewAfterAWindowInWhichTheDeviceIsSound() throws Exception {
        suspect(0);
        suspect(1);
        sound("north", 2);
        suspect(3);
        suspect(4);
        pass(4);
        assertThat(operator.extractOutputValues()).isEmpty();

        suspect(5);
        sound("north", 6);
        suspect(7);
        suspect(8);
        suspect(9);
        pass(9);
        assertThat(operator.extractOutputValues())
                .extracting(SuspectDevice::since)
                .containsExactly(3_000L, 7_000L);
    }

    @Test
    void isNotLedAstrayByVerdictsOutOfOrderAndWindowsWithoutOne() throws Exception {
        suspect(4);
        suspect(0);
        sound("north", 1);
        suspect(9);
        suspect(2);
        pass(9);

        assertThat(operator.extractOutputValues())
                .containsExactly(new SuspectDevice(verdict("north", true, 9), 3, 2_000));
    }

    @Test
    void takesADeviceForSuspectIfOneOfItsFieldsDoes() throws Exception {
        for (int window = 0; window < 3; window++) {
            sound("above", window);
            suspect(window);
            sound("overlap", window);
        }
        pass(2);

        assertThat(operator.extractOutputValues()).containsExactly(new SuspectDevice(verdict("north", true, 2), 3, 0));
    }

    @Test
    void passesOverVerdictsOfWindowsThatArePast() throws Exception {
        suspect(0);
        suspect(1);
        pass(1);
        sound("north", 1);
        suspect(2);
        pass(2);

        assertThat(operator.extractOutputValues()).hasSize(1);
    }

    @Test
    void passesOverVerdictsOfWindowsThatArePastAlsoAfterARestart() throws Exception {
        suspect(0);
        suspect(1);
        pass(1);
        restart();
        sound("north", 1);
        suspect(2);
        pass(2);

        assertThat(operator.extractOutputValues()).containsExactly(new SuspectDevice(verdict("north", true, 2), 3, 0));
    }

    @Test
    void forgetsSoundDevicesAtOnceAndSilentOnesWithTime() throws Exception {
        suspect(0);
        sound("north", 1);
        pass(1);
        assertThat(operator.numKeyedStateEntries()).isZero();

        suspect(2);
        suspect(3);
        pass(3);
        assertThat(operator.numKeyedStateEntries()).isPositive();
        operator.processWatermark(4_000 + MEMORY.toMillis());
        assertThat(operator.numKeyedStateEntries()).isZero();
        assertThat(operator.numEventTimeTimers()).isZero();

        suspect(20);
        pass(20);
        assertThat(operator.extractOutputValues()).isEmpty();
    }

    @Test
    void forgetsASilentDeviceEvenWhenEventTimeLeaps() throws Exception {
        suspect(0);
        suspect(1);
        suspect(12);
        pass(12);

        assertThat(operator.extractOutputValues()).isEmpty();
    }

    @Test
    void goesOnAfterARestartAsIfNothingHadHappened() throws Exception {
        suspect(0);
        pass(0);
        suspect(1);
        restart();
        suspect(2);
        pass(2);

        assertThat(operator.extractOutputValues()).hasSize(1);
        sound("north", 3);
        pass(3);
        assertThat(operator.numKeyedStateEntries()).isZero();
        assertThat(operator.numEventTimeTimers()).isZero();
    }

    private void restart() throws Exception {
        reported.addAll(operator.extractOutputValues());
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        operator = create();
        operator.initializeState(snapshot);
        operator.open();
    }

    private static KeyedOneInputStreamOperatorTestHarness<String, Verdict, SuspectDevice> create() throws Exception {
        return new KeyedOneInputStreamOperatorTestHarness<>(
                new KeyedLatenessOperator<>(new TrackSuspects(3, MEMORY)), Verdict::deviceIdentity, Types.STRING);
    }

    private void suspect(int window) throws Exception {
        operator.processElement(verdict("north", true, window), window);
    }

    private void sound(String field, int window) throws Exception {
        operator.processElement(verdict(field, false, window), window);
    }

    private void pass(int window) throws Exception {
        operator.processWatermark(window * 1_000L + 999);
    }

    private static Verdict verdict(String field, boolean suspect, int window) {
        return verdict("Thermometer", field, suspect, window);
    }

    private static Verdict verdict(String type, String field, boolean suspect, int window) {
        long start = window * 1_000L;
        return new Verdict("t1", Farm.INPUT, field, "canary", suspect, 60, 19, start, start + 1_000, type);
    }
}
