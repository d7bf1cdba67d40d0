package io.furrow.analytics.eventtime;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.streaming.api.TimerService;

/**
 * What came in for a key and waits for the watermark; the key's timer is set to the earliest of it. State: the list
 * {@code waiting}.
 */
public final class Inbox<T extends Timed> {
    private final ListState<T> waiting;
    private final Comparator<T> sequence;
    private final OneTimer timer;

    public Inbox(RuntimeContext context, Class<T> type, Comparator<T> sequence, OneTimer timer) {
        waiting = context.getListState(new ListStateDescriptor<>("waiting", type));
        this.sequence = sequence;
        this.timer = timer;
    }

    public void add(T message, TimerService timers) throws Exception {
        waiting.add(message);
        timer.ask(message.time(), timers);
    }

    /** Removes what the watermark has passed and returns it in sequence. */
    public List<T> takeDue(TimerService timers) throws Exception {
        List<T> due = new ArrayList<>();
        List<T> later = new ArrayList<>();
        for (T message : waiting.get()) {
            (message.time() <= timers.currentWatermark() ? due : later).add(message);
        }
        waiting.update(later);
        for (T message : later) {
            timer.ask(message.time(), timers);
        }
        due.sort(sequence);
        return due;
    }
}
