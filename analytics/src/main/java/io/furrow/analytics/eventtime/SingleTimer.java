package io.furrow.analytics.eventtime;

import java.io.IOException;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.TimerService;

/**
 * The only event-time timer of a key: it fires at the earliest instant set since it last fired. State: the value
 * {@code timer}, empty while none is set.
 */
public final class SingleTimer {
    private final ValueState<Long> set;

    public SingleTimer(RuntimeContext context) {
        set = context.getState(new ValueStateDescriptor<>("timer", Types.LONG));
    }

    public void ask(long time, TimerService timers) throws IOException {
        Long known = set.value();
        if (known != null && known <= time) {
            return;
        }
        if (known != null) {
            timers.deleteEventTimeTimer(known);
        }
        timers.registerEventTimeTimer(time);
        set.update(time);
    }

    /** Must be called first when it fires. */
    public void rang() {
        set.clear();
    }
}
