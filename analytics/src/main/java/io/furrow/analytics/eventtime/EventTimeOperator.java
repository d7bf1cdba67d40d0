package io.furrow.analytics.eventtime;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.NavigableMap;
import java.util.PriorityQueue;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.BiConsumer;
import java.util.function.ToLongFunction;

import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.java.functions.KeySelector;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.runtime.state.VoidNamespace;
import org.apache.flink.runtime.state.VoidNamespaceSerializer;
import org.apache.flink.streaming.api.operators.AbstractStreamOperator;
import org.apache.flink.streaming.api.operators.OneInputStreamOperator;
import org.apache.flink.streaming.api.operators.TimestampedCollector;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.util.Collector;

import io.furrow.flink.format.VersionedTypeInfo;

/**
 * A keyed stage that acts in event time: messages wait until the watermark has passed them and are then applied in sequence
 * to what is remembered of their key, before the watermark continues. It holds its keys in plain maps and goes through those
 * that have something to do once per watermark, because a timer per key and an access to keyed state per message cost several
 * times what is done with the message. Keyed state, the value {@code keyState}, has all of it as of the last checkpoint.
 *
 * @param <K> the keys
 * @param <M> the messages
 * @param <S> what is remembered between them
 * @param <O> what comes out, without a timestamp
 */
public abstract class EventTimeOperator<K, M extends HasEventTime, S, O> extends AbstractStreamOperator<O>
        implements OneInputStreamOperator<M, O> {
    /** For what is remembered until a message ends it. */
    protected static final long NEVER = Long.MAX_VALUE;

    private static final long serialVersionUID = 1L;
    /** Of a millisecond: a key is looked at when the watermark comes to within 64 ms of its next message. */
    private static final int STEP_BITS = 6;

    private final KeyStateSerializer<M, S> format;

    private transient Comparator<M> sequence;
    private transient KeySelector<M, K> keyOf;
    private transient ValueState<KeyState<M, S>> saved;
    private transient Map<K, Slot<K, M, S>> slots;
    /** What was saved and is no more. */
    private transient Set<K> gone;
    /** Those with messages, by the time of the earliest in steps of {@link #STEP_BITS}. */
    private transient TreeMap<Long, List<Slot<K, M, S>>> awaited;

    private transient PriorityQueue<Deadline<K, M, S>> deadlines;
    private transient List<M> due;
    private transient Collector<O> out;

    /** A key and what it has. */
    private static final class Slot<K, M extends HasEventTime, S> extends KeyState<M, S> {
        private final K key;
        /** In which it is awaited; where an earlier message came, it also stands in later ones, which are skipped. */
        private long step = NEVER;
        /** Of the earliest deadline set. */
        private long expiry = NEVER;

        private boolean changed;
        private boolean saved;

        private Slot(K key) {
            this.key = key;
        }
    }

    /** Is left where it is when the end moves away, and set again when it has passed. */
    private record Deadline<K, M extends HasEventTime, S>(long time, Slot<K, M, S> slot) {}

    protected EventTimeOperator(KeyStateSerializer<M, S> format) {
        this.format = format;
    }

    /** In which the messages of a key are applied. */
    protected abstract Comparator<M> sequence();

    /**
     * What messages do to what is remembered.
     *
     * @param before null if nothing is remembered
     * @param due in sequence; may be empty; must not be kept
     * @param until the watermark
     * @return null if nothing is remembered from now on
     */
    protected abstract S apply(K key, S before, List<M> due, long until, Collector<O> out) throws Exception;

    /** When what is remembered ends without a message, in epoch milliseconds, or {@link #NEVER}. */
    protected long expiry(S remembered) {
        return NEVER;
    }

    /** None per message: keyed state is only written for a checkpoint. */
    @Override
    public final boolean hasKeyContext1() {
        return false;
    }

    @Override
    @SuppressWarnings("unchecked") // the stream was keyed by it
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        keyOf = (KeySelector<M, K>) getStateKeySelector1();
        slots = new HashMap<>();
        gone = new HashSet<>();
        awaited = new TreeMap<>();
        deadlines = new PriorityQueue<>(Comparator.comparingLong(Deadline::time));
        ValueStateDescriptor<KeyState<M, S>> pending =
                new ValueStateDescriptor<>("pending", new VersionedTypeInfo<>(format));
        saved = context.getKeyedStateStore().getState(pending);
        if (context.isRestored()) {
            this.<K>getKeyedStateBackend()
                    .applyToAllKeys(
                            VoidNamespace.INSTANCE,
                            VoidNamespaceSerializer.INSTANCE,
                            pending,
                            (key, state) -> restore(key, state.value()));
        }
    }

    private void restore(K key, KeyState<M, S> keyState) {
        Slot<K, M, S> slot = new Slot<>(key);
        slot.takeOver(format.copy(keyState));
        slot.saved = true;
        slots.put(key, slot);
        if (!slot.waiting.isEmpty()) {
            await(slot, slot.earliest());
        }
        if (slot.remembered != null) {
            expireAt(slot, expiry(slot.remembered));
        }
    }

    /**
     * Forgets what is remembered of each key; before the first message.
     *
     * @param waiting whether messages that wait are forgotten too
     * @param last takes what was remembered and what takes records
     */
    protected final void forget(boolean waiting, BiConsumer<S, Collector<O>> last) {
        for (Slot<K, M, S> slot : List.copyOf(slots.values())) {
            if (slot.remembered != null) {
                last.accept(slot.remembered, out);
            }
            slot.remembered = null;
            if (waiting) {
                slot.waiting.clear();
            }
            slot.changed = true;
            settle(slot);
        }
    }

    @Override
    public void open() throws Exception {
        super.open();
        sequence = sequence();
        due = new ArrayList<>();
        TimestampedCollector<O> collector = new TimestampedCollector<>(output);
        collector.eraseTimestamp();
        out = collector;
    }

    @Override
    public void processElement(StreamRecord<M> record) throws Exception {
        offer(record.getValue(), Integer.MAX_VALUE);
    }

    /**
     * Lets a message wait for the watermark, unless so many of its key do.
     *
     * @return whether it waits
     */
    protected final boolean offer(M message, int most) throws Exception {
        Slot<K, M, S> slot = slots.computeIfAbsent(keyOf.getKey(message), Slot::new);
        if (slot.waiting.size() >= most) {
            return false;
        }
        slot.waiting.add(message);
        slot.changed = true;
        await(slot, message.time());
        return true;
    }

    /**
     * The newest time of what waits of a key and of what is remembered of it; {@link Long#MIN_VALUE} where there is neither.
     *
     * @param time of what is remembered
     */
    protected final long newest(K key, ToLongFunction<S> time) {
        Slot<K, M, S> slot = slots.get(key);
        if (slot == null) {
            return Long.MIN_VALUE;
        }
        long newest = slot.remembered == null ? Long.MIN_VALUE : time.applyAsLong(slot.remembered);
        for (M message : slot.waiting) {
            newest = Math.max(newest, message.time());
        }
        return newest;
    }

    private void await(Slot<K, M, S> slot, long time) {
        long step = time >> STEP_BITS;
        if (step < slot.step) {
            slot.step = step;
            awaited.computeIfAbsent(step, none -> new ArrayList<>()).add(slot);
        }
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        long until = mark.getTimestamp();
        while (!deadlines.isEmpty() && deadlines.peek().time <= until) {
            Slot<K, M, S> slot = deadlines.poll().slot;
            slot.expiry = NEVER;
            advance(slot, until);
        }
        NavigableMap<Long, List<Slot<K, M, S>>> passed = awaited.headMap(until >> STEP_BITS, true);
        Map<Long, List<Slot<K, M, S>>> visited = new TreeMap<>(passed);
        passed.clear();
        for (Map.Entry<Long, List<Slot<K, M, S>>> step : visited.entrySet()) {
            for (Slot<K, M, S> slot : step.getValue()) {
                if (slot.step == step.getKey()) {
                    slot.step = NEVER;
                    advance(slot, until);
                }
            }
        }
        super.processWatermark(mark);
    }

    private void advance(Slot<K, M, S> slot, long until) throws Exception {
        if (slot.isEmpty()) {
            return; // it was awaited for something that is done
        }
        due.clear();
        slot.takeDue(until, due);
        if (due.size() > 1) {
            due.sort(sequence);
        }
        S now = apply(slot.key, slot.remembered, due, until, out);
        slot.changed |= !due.isEmpty() || now != slot.remembered;
        slot.remembered = now;
        settle(slot);
    }

    /** Forgets a key without anything, and sees to it that one with something is looked at in time. */
    private void settle(Slot<K, M, S> slot) {
        if (slot.isEmpty()) {
            slots.remove(slot.key, slot);
            if (slot.saved) {
                gone.add(slot.key);
            }
            return;
        }
        if (!slot.waiting.isEmpty()) {
            await(slot, slot.earliest());
        }
        if (slot.remembered != null) {
            expireAt(slot, expiry(slot.remembered));
        }
    }

    private void expireAt(Slot<K, M, S> slot, long time) {
        if (time < slot.expiry) {
            slot.expiry = time;
            deadlines.add(new Deadline<>(time, slot));
        }
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        for (K key : gone) {
            setCurrentKey(key);
            saved.clear();
        }
        gone.clear();
        for (Slot<K, M, S> slot : slots.values()) {
            if (slot.changed) {
                setCurrentKey(slot.key);
                saved.update(format.copy(slot));
                slot.saved = true;
                slot.changed = false;
            }
        }
    }
}
