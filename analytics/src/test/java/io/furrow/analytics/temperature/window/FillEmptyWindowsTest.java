package io.furrow.analytics.temperature.window;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithKeyedOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedTwoInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.field.FieldRecords;
import io.furrow.analytics.field.KnownFields;
import io.furrow.analytics.temperature.Farm;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.flink.record.TopicRecord;

import static org.assertj.core.api.Assertions.assertThat;

/** Windows of two seconds, one beginning each second; a silent field gives results for five seconds. */
class FillEmptyWindowsTest {
    private static final TemperatureOptions OPTIONS =
            Farm.options(Farm.FIELDS, "--window", "2s", "--slide", "1s", "--empty-windows", "5s");

    private final FieldRecords fields = new FieldRecords();
    private KeyedTwoInputStreamOperatorTestHarness<String, FieldAverage, TopicRecord, FieldAverage> operator;

    @BeforeEach
    void open() throws Exception {
        fields.square("north", 0, "canary");
        operator = create();
        operator.open();
        operator.processWatermark2(new Watermark(Long.MAX_VALUE - 1));
    }

    @AfterEach
    void close() throws Exception {
        operator.close();
    }

    @Test
    void addsAResultOfNoDevicesWhenEventTimePassesAWindowWithoutAReading() throws Exception {
        heard(0);
        pass(0);
        assertThat(windows()).containsExactly("0");
        pass(1);
        pass(2);
        assertThat(windows()).containsExactly("0", "1 empty", "2 empty");
        assertThat(operator.extractOutputValues().get(1))
                .isEqualTo(
                        new FieldAverage("north", "canary", Farm.INPUT, 1_000, 3_000, RobustMean.OF_NONE, List.of()));

        heard(3);
        pass(3);
        heard(4);
        pass(5);
        assertThat(windows()).containsExactly("0", "1 empty", "2 empty", "3", "4", "5 empty");
    }

    @Test
    void fillsTheWindowsThatAResultLeavesOut() throws Exception {
        heard(0);
        heard(3);
        pass(3);

        assertThat(windows()).containsExactly("0", "1 empty", "2 empty", "3");
    }

    @Test
    void stopsAfterTheLimitAndForgetsTheField() throws Exception {
        heard(0);
        pass(90);
        assertThat(windows()).containsExactly("0", "1 empty", "2 empty", "3 empty", "4 empty", "5 empty");
        assertNothingIsLeft();

        heard(95);
        pass(96);
        assertThat(windows()).endsWith("95", "96 empty").hasSize(8);
    }

    @Test
    void fillsNoMoreThanTheLimitBeforeAResult() throws Exception {
        heard(0);
        heard(90);

        assertThat(windows()).containsExactly("0", "1 empty", "2 empty", "3 empty", "4 empty", "5 empty", "90");
    }

    @Test
    void stopsWhenTheFieldEnds() throws Exception {
        heard(0);
        operator.processElement2(new StreamRecord<>(fields.end("north", 2_500)));
        pass(9);

        assertThat(windows()).as("the field is there when window 2 begins").containsExactly("0", "1 empty", "2 empty");
        assertNothingIsLeft();
    }

    @Test
    void takesTheDomainThatTheFieldHasByThen() throws Exception {
        heard(0);
        operator.processElement2(new StreamRecord<>(fields.square("north", 3_500, "dairy")));
        pass(3);

        assertThat(operator.extractOutputValues())
                .extracting(FieldAverage::domain)
                .containsExactly("canary", "canary", "dairy", "dairy");
    }

    @Test
    void addsNothingAfterTheLastReadingOfABoundedInput() throws Exception {
        heard(0);
        heard(2);
        operator.processWatermark1(Watermark.MAX_WATERMARK);
        operator.processWatermark2(Watermark.MAX_WATERMARK);

        assertThat(windows()).containsExactly("0", "1 empty", "2");
        assertNothingIsLeft();
    }

    @Test
    void passesACorrectionOnThatComesAfterAnEmptyResult() throws Exception {
        heard(0);
        pass(2);
        heard(1);
        pass(3);

        assertThat(windows()).containsExactly("0", "1 empty", "2 empty", "1", "3 empty");
    }

    @Test
    void goesOnAfterARestartAsIfNothingHadHappened() throws Exception {
        heard(0);
        pass(1);
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        operator = create();
        operator.initializeState(snapshot);
        operator.open();
        operator.processWatermark2(new Watermark(Long.MAX_VALUE - 1));
        pass(2);

        assertThat(windows()).containsExactly("2 empty");
    }

    private void assertNothingIsLeft() {
        assertThat(operator.numKeyedStateEntries()).isZero();
        assertThat(operator.numEventTimeTimers()).isZero();
    }

    private KeyedTwoInputStreamOperatorTestHarness<String, FieldAverage, TopicRecord, FieldAverage> create()
            throws Exception {
        return new KeyedTwoInputStreamOperatorTestHarness<>(
                new CoBroadcastWithKeyedOperator<>(
                        new FillEmptyWindows(fields.atStart(), OPTIONS), List.of(KnownFields.BROADCAST)),
                FieldAverage::fieldIdentity,
                null,
                Types.STRING);
    }

    private void heard(int window) throws Exception {
        long start = window * 1_000L;
        RobustMean mean = RobustMean.of(Map.of("t1", 18.0), 0);
        operator.processElement1(new StreamRecord<>(
                new FieldAverage("north", "canary", Farm.INPUT, start, start + 2_000, mean, List.of()), start + 1_999));
    }

    private void pass(int window) throws Exception {
        operator.processWatermark1(new Watermark(window * 1_000L + 1_999));
    }

    private List<String> windows() {
        List<String> windows = new ArrayList<>();
        for (FieldAverage result : operator.extractOutputValues()) {
            windows.add(result.windowStart() / 1_000 + (result.average().devices() == 0 ? " empty" : ""));
        }
        return windows;
    }
}
