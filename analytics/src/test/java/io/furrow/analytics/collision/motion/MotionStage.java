package io.furrow.analytics.collision.motion;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.api.java.functions.KeySelector;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.api.operators.OneInputStreamOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.time.KeyedLatenessOperator;

/** One keyed stage alone, with time as data; can be stopped with a snapshot and continue from it. */
final class MotionStage<K, I extends HasEventTime, O> {
    private final Supplier<OneInputStreamOperator<I, O>> operator;
    private final KeySelector<I, K> key;
    private final TypeInformation<K> keyType;
    private KeyedOneInputStreamOperatorTestHarness<K, I, O> harness;

    private MotionStage(
            Supplier<OneInputStreamOperator<I, O>> operator, KeySelector<I, K> key, TypeInformation<K> keyType)
            throws Exception {
        this.operator = operator;
        this.key = key;
        this.keyType = keyType;
        start();
        harness.open();
    }

    static MotionStage<String, PositionFix, SegmentUpdate> track(MotionRules rules) throws Exception {
        return new MotionStage<>(
                () -> new KeyedLatenessOperator<>(new TrackMotion(rules)), PositionFix::key, Types.STRING);
    }

    static MotionStage<Long, SegmentUpdate, ApproachCandidate> match(MotionRules rules) throws Exception {
        return new MotionStage<>(
                () -> new KeyedProcessOperator<>(new MatchSegments(rules)), SegmentUpdate::cube, Types.LONG);
    }

    static MotionStage<String, ApproachCandidate, Approach> predict(MotionRules rules) throws Exception {
        return new MotionStage<>(
                () -> new KeyedProcessOperator<>(new TrackPredictions(rules)), ApproachCandidate::pair, Types.STRING);
    }

    static MotionStage<String, ApproachCandidate, Approach> join(MotionRules rules) throws Exception {
        return new MotionStage<>(
                () -> new KeyedProcessOperator<>(new JoinContacts(rules)), ApproachCandidate::pair, Types.STRING);
    }

    void receive(List<I> inputs) throws Exception {
        for (I input : inputs) {
            harness.processElement(input, input.time());
        }
    }

    /** What comes out on the way to the watermark. */
    List<O> advance(long watermark) throws Exception {
        harness.processWatermark(new Watermark(watermark));
        List<O> out = new ArrayList<>(harness.extractOutputValues());
        harness.getOutput().clear();
        return out;
    }

    /** What went aside since this was last asked. */
    <T> List<T> aside(OutputTag<T> tag) {
        var output = harness.getSideOutput(tag);
        if (output == null) {
            return List.of();
        }
        List<T> all = output.stream().map(StreamRecord::getValue).toList();
        output.clear();
        return new ArrayList<>(all);
    }

    boolean isEmpty() {
        return harness.numKeyedStateEntries() == 0 && harness.numEventTimeTimers() == 0;
    }

    void restart() throws Exception {
        OperatorSubtaskState snapshot = harness.snapshot(1, 1);
        harness.close();
        start();
        harness.initializeState(snapshot);
        harness.open();
    }

    private void start() throws Exception {
        harness = new KeyedOneInputStreamOperatorTestHarness<>(operator.get(), key, keyType);
    }

    void stop() throws Exception {
        harness.close();
    }
}
