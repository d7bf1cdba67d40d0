package io.furrow.analytics.collision.encounter;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import java.util.function.ToLongFunction;

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

import io.furrow.analytics.collision.debounce.DebounceEncounters;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.TrackDevices;
import io.furrow.analytics.collision.matching.MatchPairs;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

/** One keyed stage alone, with time as data; can be stopped with a snapshot and continue from it. */
public final class Stage<K, I, O> {
    private final ToLongFunction<I> time;
    private Supplier<OneInputStreamOperator<I, O>> operator;
    private final KeySelector<I, K> key;
    private final TypeInformation<K> keyType;
    private KeyedOneInputStreamOperatorTestHarness<K, I, O> harness;

    private Stage(
            Supplier<OneInputStreamOperator<I, O>> operator,
            KeySelector<I, K> key,
            TypeInformation<K> keyType,
            ToLongFunction<I> time)
            throws Exception {
        this.time = time;
        this.operator = operator;
        this.key = key;
        this.keyType = keyType;
        start();
        harness.open();
    }

    public static <K, I extends HasEventTime, O> Stage<K, I, O> of(
            Supplier<OneInputStreamOperator<I, O>> operator, KeySelector<I, K> key, TypeInformation<K> keyType)
            throws Exception {
        return new Stage<>(operator, key, keyType, HasEventTime::time);
    }

    public static Stage<Device, PositionFix, CellUpdate> track(CollisionRules rules) throws Exception {
        return new Stage<>(
                () -> new TrackDevices(rules),
                PositionFix::device,
                TypeInformation.of(Device.class),
                PositionFix::time);
    }

    public static Stage<Long, CellUpdate, PairObservation> match(CollisionRules rules) throws Exception {
        return new Stage<>(() -> new MatchPairs(rules), CellUpdate::cell, Types.LONG, CellUpdate::time);
    }

    static Stage<Pair, PairObservation, Encounter> follow(CollisionRules rules) throws Exception {
        return new Stage<>(
                () -> new TrackEncounters(rules),
                PairObservation::pair,
                TypeInformation.of(Pair.class),
                PairObservation::time);
    }

    public static Stage<Pair, Encounter, Encounter> steady(CollisionRules rules) throws Exception {
        return new Stage<>(
                () -> new KeyedProcessOperator<>(new DebounceEncounters(rules)),
                Encounter::pair,
                TypeInformation.of(Pair.class),
                Encounter::time);
    }

    public void receive(List<I> inputs) throws Exception {
        for (I input : inputs) {
            receive(input);
        }
    }

    public void receive(I input) throws Exception {
        harness.processElement(input, time.applyAsLong(input));
    }

    /** What comes out on the way to the watermark. */
    public List<O> advance(long watermark) throws Exception {
        harness.processWatermark(new Watermark(watermark));
        return told();
    }

    /** What has come out since this was last asked. */
    public List<O> told() {
        List<O> out = new ArrayList<>(harness.extractOutputValues());
        harness.getOutput().clear();
        return out;
    }

    public <T> List<T> side(OutputTag<T> tag) {
        var output = harness.getSideOutput(tag);
        return output == null
                ? List.of()
                : output.stream().map(StreamRecord::getValue).toList();
    }

    /** What went aside since this was last asked. */
    public <T> List<T> aside(OutputTag<T> tag) {
        List<T> aside = new ArrayList<>(side(tag));
        if (!aside.isEmpty()) {
            harness.getSideOutput(tag).clear();
        }
        return aside;
    }

    /** As of a checkpoint now. */
    public int stateEntries() throws Exception {
        harness.snapshot(2, 2);
        return harness.numKeyedStateEntries();
    }

    public void restart() throws Exception {
        OperatorSubtaskState snapshot = harness.snapshot(1, 1);
        harness.close();
        start();
        harness.initializeState(snapshot);
        harness.open();
    }

    /** From the snapshot of another, by rules of its own; what comes out at once is told. */
    Stage<K, I, O> restartAs(Stage<K, I, O> other) throws Exception {
        operator = other.operator;
        other.stop();
        restart();
        return this;
    }

    private void start() throws Exception {
        harness = new KeyedOneInputStreamOperatorTestHarness<>(operator.get(), key, keyType);
    }

    public void stop() throws Exception {
        harness.close();
    }

    /** Stops it where it knows nothing any more. */
    public void stopEmpty() throws Exception {
        assertThat(stateEntries()).isZero();
        assertThat(harness.numEventTimeTimers()).isZero();
        stop();
    }
}
