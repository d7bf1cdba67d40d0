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
 * to their key's state, before the watermark is forwarded. Keys live in plain maps, and once per watermark those that are due
 * are processed, because a timer per key and an access to keyed state per message cost several times the processing itself.
 * Keyed state, the value {@code pending}, holds them as of the last checkpoint.
 *
 * @param <K> the keys
 * @param <M> the messages
 * @param <S> the state of a key
 * @param <O> the output, without a timestamp
 */
public abstract class EventTimeOperator<K, M extends HasEventTime, S, O> extends AbstractStreamOperator<O>
        implements OneInputStreamOperator<M, O> {
    /** The expiry of state that only a message ends. */
    protected static final long NEVER = Long.MAX_VALUE;

    private static final long serialVersionUID = 1L;
    /** Steps of 64 ms: a key is processed when the watermark reaches the step of its next message. */
    private static final int STEP_BITS = 6;

    private final KeyStateSerializer<M, S> format;

    private transient Comparator<M> sequence;
    private transient KeySelector<M, K> keyOf;
    private transient ValueState<KeyState<M, S>> saved;
    private transient Map<K, Slot<K, M, S>> slots;
    /** Saved keys that have no state any more. */
    private transient Set<K> gone;
    /** Slots with messages, by the time of the earliest in steps of {@link #STEP_BITS}. */
    private transient TreeMap<Long, List<Slot<K, M, S>>> awaited;

    private transient PriorityQueue<Deadline<K, M, S>> deadlines;
    private transient List<M> due;
    private transient Collector<O> out;

    /** A key with its state. */
    private static final class Slot<K, M extends HasEventTime, S> extends KeyState<M, S> {
        private final K key;
        /** Step in which it is awaited; it may also be listed in later ones, which are then skipped. */
        private long step = NEVER;
        /** Earliest deadline set. */
        private long expiry = NEVER;

        private boolean changed;
        private boolean saved;

        private Slot(K key) {
            this.key = key;
        }
    }

    /** Not moved when the expiry moves to later; set again once it has passed. */
    private record Deadline<K, M extends HasEventTime, S>(long time, Slot<K, M, S> slot) {}

    protected EventTimeOperator(KeyStateSerializer<M, S> format) {
        this.format = format;
    }

    /** The order in which the messages of a key are applied. */
    protected abstract Comparator<M> sequence();

    /**
     * Applies messages to the state of a key.
     *
     * @param before null if there is no state
     * @param due in sequence; may be empty; must not be retained
     * @param until the watermark
     * @return the new state, or null for none
     */
    protected abstract S apply(K key, S before, List<M> due, long until, Collector<O> out) throws Exception;

    /** When the state ends without a message, in epoch milliseconds, or {@link #NEVER}. */
    protected long expiry(S remembered) {
        return NEVER;
    }

    /** No key context per message: keyed state is only written for a checkpoint. */
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
     * Clears the state of each key; call it before the first message.
     *
     * @param waiting whether waiting messages are dropped too
     * @param last receives each former state, and the output
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
     * Buffers a message until the watermark, unless its key has the maximum number of them.
     *
     * @return whether it was buffered
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
     * The newest time of a key's waiting messages and of its state; {@link Long#MIN_VALUE} if it has neither.
     *
     * @param time of the state
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
            return; // its messages have been processed already
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

    /** Removes an empty key, or schedules when it is next due. */
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
