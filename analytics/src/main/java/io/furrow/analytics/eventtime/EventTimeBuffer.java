package io.furrow.analytics.eventtime;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.java.typeutils.ListTypeInfo;
import org.apache.flink.streaming.api.TimerService;

/**
 * Buffers a key's messages until the watermark passes them; sets the key's timer to the earliest. State: the value
 * {@code waiting}, one list, empty while nothing waits.
 */
public final class EventTimeBuffer<T extends HasEventTime> {
    private final ValueState<List<T>> waiting;
    private final Comparator<T> sequence;
    private final SingleTimer timer;

    public EventTimeBuffer(RuntimeContext context, Class<T> type, Comparator<T> sequence, SingleTimer timer) {
        ListTypeInfo<T> list = new ListTypeInfo<>(TypeInformation.of(type));
        waiting = context.getState(new ValueStateDescriptor<>("waiting", list));
        this.sequence = sequence;
        this.timer = timer;
    }

    public void add(T message, TimerService timers) throws Exception {
        List<T> before = waiting.value();
        List<T> now = before == null ? new ArrayList<>(1) : before;
        now.add(message);
        waiting.update(now);
        timer.ask(message.time(), timers);
    }

    /**
     * The same, up to a maximum number of messages.
     *
     * @return whether the message was buffered
     */
    public boolean offer(T message, int most, TimerService timers) throws Exception {
        List<T> before = waiting.value();
        if (before != null && before.size() >= most) {
            return false;
        }
        add(message, timers);
        return true;
    }

    /** The newest time of the buffered messages; {@link Long#MIN_VALUE} without any. */
    public long newest() throws Exception {
        List<T> all = waiting.value();
        long newest = Long.MIN_VALUE;
        for (T message : all == null ? List.<T>of() : all) {
            newest = Math.max(newest, message.time());
        }
        return newest;
    }

    public boolean isEmpty() throws Exception {
        return waiting.value() == null;
    }

    /** Removes the messages that the watermark has passed and returns them in sequence. */
    public List<T> takeDue(TimerService timers) throws Exception {
        List<T> all = waiting.value();
        if (all == null) {
            return List.of();
        }
        List<T> due = new ArrayList<>(all.size());
        List<T> later = new ArrayList<>(0);
        for (T message : all) {
            (message.time() <= timers.currentWatermark() ? due : later).add(message);
        }
        if (later.isEmpty()) {
            waiting.clear();
        } else {
            waiting.update(later);
            timer.ask(earliest(later), timers);
        }
        due.sort(sequence);
        return due;
    }

    private static long earliest(List<? extends HasEventTime> messages) {
        long earliest = Long.MAX_VALUE;
        for (HasEventTime message : messages) {
            earliest = Math.min(earliest, message.time());
        }
        return earliest;
    }
}
