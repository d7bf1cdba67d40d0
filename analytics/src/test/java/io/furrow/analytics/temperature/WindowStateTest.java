package io.furrow.analytics.temperature;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.dag.Transformation;
import org.apache.flink.api.java.functions.KeySelector;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.transformations.OneInputTransformation;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.position.Position;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

/** The operators as the job defines them, taken out of it and fed by hand. */
class WindowStateTest {
    private static final long MINUTE = Duration.ofMinutes(1).toMillis();
    private static final TemperatureOptions OPTIONS =
            Farm.options(Farm.FIELDS, "--slide", "30s", "--allowed-lateness", "10s");

    private final List<KeyedOneInputStreamOperatorTestHarness<?, ?, ?>> opened = new ArrayList<>();

    @AfterEach
    void closeOperators() throws Exception {
        for (KeyedOneInputStreamOperatorTestHarness<?, ?, ?> operator : opened) {
            operator.close();
        }
    }

    @Test
    void votesLeaveNothingBehindWhenTheirWindowsClose() throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, FieldReading, DeviceVote> votes = operator("cast-votes");
        for (int second = 0; second < 60; second++) {
            votes.processElement(inField("t" + second % 5, 18, second * 1_000L), second * 1_000L);
        }
        votes.processWatermark(MINUTE - 1);
        assertThat(votes.extractOutputValues()).as("of two windows that ended").hasSize(10);
        assertThat(votes.numKeyedStateEntries()).isPositive();
        assertThat(votes.numEventTimeTimers()).isPositive();

        votes.processElement(inField("t1", 20, MINUTE - 1), MINUTE - 1);
        assertThat(votes.extractOutputValues())
                .as("late, within the allowed lateness")
                .hasSize(11);

        votes.processWatermark(2 * MINUTE);
        assertThat(votes.numKeyedStateEntries()).isZero();
        assertThat(votes.numEventTimeTimers()).isZero();
    }

    @Test
    void averagesLeaveNothingBehindWhenTheirWindowsClose() throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, DeviceVote, FieldAverage> averages = operator("average-votes");
        for (int device = 0; device < 5; device++) {
            averages.processElement(vote("t" + device, 18), MINUTE - 1);
        }
        assertThat(averages.numKeyedStateEntries()).isPositive();

        averages.processWatermark(MINUTE - 1);
        assertThat(averages.extractOutputValues()).hasSize(1);
        averages.processWatermark(2 * MINUTE);
        assertThat(averages.numKeyedStateEntries()).isZero();
        assertThat(averages.numEventTimeTimers()).isZero();
    }

    @Test
    void averagesTakeAVoteOfEachTypeOfAnId() throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, DeviceVote, FieldAverage> averages = operator("average-votes");
        averages.processElement(vote("Thermometer", "t0", 18), MINUTE - 1);
        averages.processElement(vote("Station", "t0", 18), MINUTE - 1);
        averages.processElement(vote("Thermometer", "t1", 60), MINUTE - 1);

        averages.processWatermark(MINUTE - 1);
        assertThat(averages.extractOutputValues())
                .singleElement()
                .extracting(FieldAverage::average)
                .returns(3, RobustMean::devices)
                .returns(32.0, RobustMean::plainMean);
    }

    @Test
    void idsOfEventsAreForgottenOnceARepetitionWouldBeLate() throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, Reading, Reading> once = operator("deduplicate-by-id");
        Reading reading = inField("t1", 18, 1_000).reading();
        once.processElement(reading, 1_000);
        once.processWatermark(MINUTE + 10_000);
        once.processElement(reading, 1_000);
        assertThat(once.extractOutputValues()).as("as long as it could count").hasSize(1);
        assertThat(once.numKeyedStateEntries()).isPositive();

        once.processWatermark(3 * MINUTE);
        assertThat(once.numKeyedStateEntries()).isZero();
        assertThat(once.numEventTimeTimers()).isZero();
    }

    @Test
    void goesOnAfterARestartAsIfNothingHadHappened() throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, FieldReading, DeviceVote> votes = operator("cast-votes");
        votes.processElement(inField("t1", 10, 31_000), 31_000);
        votes.processElement(inField("t1", 40, 32_000), 32_000);
        OperatorSubtaskState snapshot = votes.snapshot(1, 1);
        KeyedOneInputStreamOperatorTestHarness<String, FieldReading, DeviceVote> again =
                restored("cast-votes", snapshot);
        again.processElement(inField("t1", 20, 33_000), 33_000);
        again.processWatermark(MINUTE - 1);

        assertThat(again.extractOutputValues()).isEqualTo(List.of(vote("t1", 20)));
    }

    @Test
    void endsWindowsAsTheyBeganWhereAnotherLengthIsRestored() throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, FieldReading, DeviceVote> minutes = operator("cast-votes");
        minutes.processElement(inField("t1", 10, 31_000), 31_000);
        OperatorSubtaskState snapshot = minutes.snapshot(1, 1);
        KeyedOneInputStreamOperatorTestHarness<String, FieldReading, DeviceVote> halves =
                outOfTheJob("cast-votes", Farm.options(Farm.FIELDS, "--window", "30s"));
        halves.initializeState(snapshot);
        halves.open();
        halves.processElement(inField("t1", 20, 40_000), 40_000);
        halves.processElement(inField("t1", 30, 70_000), 70_000);
        halves.processWatermark(2 * MINUTE - 1);

        assertThat(halves.extractOutputValues())
                .extracting(DeviceVote::windowStart, DeviceVote::windowEnd, DeviceVote::value)
                .containsExactlyInAnyOrder(
                        tuple(0L, MINUTE, 10.0),
                        tuple(MINUTE / 2, 3 * MINUTE / 2, 10.0),
                        tuple(MINUTE / 2, MINUTE, 20.0),
                        tuple(MINUTE, 3 * MINUTE / 2, 30.0));
        assertThat(halves.numKeyedStateEntries()).isZero();
    }

    @Test
    void leavesAWindowClosedThatAnEarlierRunHasClosed() throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, FieldReading, DeviceVote> votes = operator("cast-votes");
        votes.processElement(inField("t1", 10, 31_000), 31_000);
        votes.processWatermark(2 * MINUTE);
        assertThat(votes.extractOutputValues()).hasSize(2);
        KeyedOneInputStreamOperatorTestHarness<String, FieldReading, DeviceVote> again =
                restored("cast-votes", votes.snapshot(1, 1));

        FieldReading late = inField("t1", 20, 32_000);
        again.processElement(late, 32_000);
        again.processElement(inField("t2", 20, 75_000), 75_000);
        again.processWatermark(2 * MINUTE);

        assertThat(again.getSideOutput(VoteStage.LATE))
                .extracting(StreamRecord::getValue)
                .containsExactly(late);
        assertThat(again.extractOutputValues())
                .as("the window that still takes late readings")
                .extracting(DeviceVote::device, DeviceVote::windowStart)
                .containsExactly(tuple("t2", MINUTE));
    }

    private static FieldReading inField(String device, double value, long time) {
        TopicRecord record = Farm.north(device, value, time);
        return new FieldReading(
                "north",
                "canary",
                0,
                new Reading(device, "Thermometer", Farm.SCOPE, new Position(52, 12), value, "id-" + time, record));
    }

    private static DeviceVote vote(String device, double value) {
        return vote("Thermometer", device, value);
    }

    private static DeviceVote vote(String type, String device, double value) {
        return new DeviceVote("north", "canary", 0, Farm.INPUT, device, value, 0, MINUTE, type);
    }

    private <I, O> KeyedOneInputStreamOperatorTestHarness<String, I, O> operator(String uid) throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, I, O> operator = outOfTheJob(uid);
        operator.open();
        return operator;
    }

    private <I, O> KeyedOneInputStreamOperatorTestHarness<String, I, O> restored(String uid, OperatorSubtaskState state)
            throws Exception {
        KeyedOneInputStreamOperatorTestHarness<String, I, O> operator = outOfTheJob(uid);
        operator.initializeState(state);
        operator.open();
        return operator;
    }

    private <I, O> KeyedOneInputStreamOperatorTestHarness<String, I, O> outOfTheJob(String uid) throws Exception {
        return outOfTheJob(uid, OPTIONS);
    }

    @SuppressWarnings("unchecked") // the job's own types, which its graph does not carry
    private <I, O> KeyedOneInputStreamOperatorTestHarness<String, I, O> outOfTheJob(
            String uid, TemperatureOptions options) throws Exception {
        StreamExecutionEnvironment env = JobRun.environment(options);
        Transformation<?> job = TemperatureJob.define(
                        JobRun.inputs(env, List.of(Farm.north("t", 1, 1)), options), options)
                .getTransformation();
        var operator = (OneInputTransformation<I, O>) job.getTransitivePredecessors().stream()
                .filter(step -> uid.equals(step.getUid()))
                .findFirst()
                .orElseThrow();
        var harness = new KeyedOneInputStreamOperatorTestHarness<>(
                operator.getOperatorFactory(),
                (KeySelector<I, String>) operator.getStateKeySelector(),
                (TypeInformation<String>) operator.getStateKeyType());
        harness.setup(operator.getOutputType().createSerializer(env.getConfig().getSerializerConfig()));
        opened.add(harness);
        return harness;
    }
}
