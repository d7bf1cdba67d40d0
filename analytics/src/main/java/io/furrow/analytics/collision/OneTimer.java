package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.TimerService;

/** The only event-time timer of a key: it rings at the earliest instant that was asked for since it last rang. */
final class OneTimer {
    private final ValueState<Long> set;

    OneTimer(RuntimeContext context) {
        set = context.getState(new ValueStateDescriptor<>("timer", Types.LONG));
    }

    void ask(long time, TimerService timers) throws IOException {
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

    /** To be called first when it rings. */
    void rang() {
        set.clear();
    }
}
