package io.furrow.analytics.eventtime;

import java.util.Comparator;
import java.util.List;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.TimerService;

import io.furrow.analytics.format.FormatType;

/**
 * The whole state of a key in one value, {@code pending}: on the heap an access costs more than what is done with the value.
 * Messages wait in it until the watermark has passed them and are then applied in sequence to what is remembered. A key has
 * one timer for its earliest message and one for the end of what is remembered. The latter is left where it is when the end
 * moves away, and set anew when it rings: to move it with every message would cost more than the message.
 */
public final class PendingState<M extends Timed, S> {
    /** For what is remembered until a message ends it. */
    public static final long NEVER = Pending.NO_TIMER;

    private final ValueState<Pending<M, S>> state;
    private final Comparator<M> sequence;

    /** What messages do to what is remembered. */
    public interface Step<M, S> {
        /**
         * @param before null where nothing is remembered
         * @param due in sequence; may be empty
         * @return null where nothing is remembered from now on
         */
        S apply(S before, List<M> due) throws Exception;
    }

    /** When what is remembered ends, in epoch milliseconds, or {@link #NEVER}. */
    public interface Expiry<S> {
        long of(S remembered);
    }

    public PendingState(RuntimeContext context, PendingFormat<M, S> format, Comparator<M> sequence) {
        state = context.getState(new ValueStateDescriptor<>("pending", new FormatType<>(format)));
        this.sequence = sequence;
    }

    public void add(M message, TimerService timers) throws Exception {
        Pending<M, S> before = state.value();
        Pending<M, S> pending = before == null ? new Pending<>() : before;
        pending.waiting.add(message);
        wake(pending, message.time(), timers);
        state.update(pending);
    }

    /** To be called when a timer rings: applies all that the watermark has passed. */
    public void advance(long rang, TimerService timers, Step<M, S> step, Expiry<S> expiry) throws Exception {
        Pending<M, S> pending = state.value();
        if (pending == null) {
            return;
        }
        pending.rang(rang);
        List<M> due = pending.takeDue(timers.currentWatermark());
        due.sort(sequence);
        pending.remembered = step.apply(pending.remembered, due);
        wake(pending, pending.earliest(), timers);
        if (pending.remembered != null) {
            expire(pending, expiry.of(pending.remembered), timers);
        }
        if (pending.isEmpty()) {
            state.clear();
        } else {
            state.update(pending);
        }
    }

    private static void wake(Pending<?, ?> pending, long time, TimerService timers) {
        if (time >= pending.wakeAt) {
            return;
        }
        if (pending.wakeAt != Pending.NO_TIMER && pending.wakeAt != pending.expiryAt) {
            timers.deleteEventTimeTimer(pending.wakeAt);
        }
        timers.registerEventTimeTimer(time);
        pending.wakeAt = time;
    }

    private static void expire(Pending<?, ?> pending, long time, TimerService timers) {
        if (time >= pending.expiryAt) {
            return;
        }
        if (pending.expiryAt != Pending.NO_TIMER && pending.expiryAt != pending.wakeAt) {
            timers.deleteEventTimeTimer(pending.expiryAt);
        }
        timers.registerEventTimeTimer(time);
        pending.expiryAt = time;
    }
}
