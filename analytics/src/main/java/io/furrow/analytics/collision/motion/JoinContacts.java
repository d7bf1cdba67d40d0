package io.furrow.analytics.collision.motion;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;

/**
 * Joins contacts of consecutive segments into one crossing. Key: the pair.
 *
 * <p><b>State</b>: candidates that wait for the watermark; a contact that may continue.
 *
 * <p><b>Cleared</b>: when the contact ended, at the latest one time-to-live after its last segment, and no candidate waits.
 *
 * <p><b>Late</b>: impossible; the previous stage acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: one record for each contact that no report shows.
 */
final class JoinContacts extends KeyedProcessFunction<String, ApproachCandidate, Approach> {
    private static final long serialVersionUID = 1L;

    private final long timeToLive;

    private transient SingleTimer timer;
    private transient EventTimeBuffer<ApproachCandidate> eventTimeBuffer;
    private transient ValueState<Contact> contact;

    JoinContacts(MotionRules rules) {
        timeToLive = rules.timeToLive();
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer =
                new EventTimeBuffer<>(getRuntimeContext(), ApproachCandidate.class, ApproachCandidate.SEQUENCE, timer);
        contact = getRuntimeContext().getState(new ValueStateDescriptor<>("contact", Contact.class));
    }

    @Override
    public void processElement(ApproachCandidate candidate, Context context, Collector<Approach> out) throws Exception {
        eventTimeBuffer.add(candidate, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Approach> out) throws Exception {
        timer.rang();
        List<ApproachCandidate> due = eventTimeBuffer.takeDue(context.timerService());
        Contact open = Contact.join(contact.value(), due, out::collect);
        if (open != null && open.until() + timeToLive <= context.timerService().currentWatermark()) {
            Contact.close(open, out::collect);
            open = null;
        }
        if (open == null) {
            contact.clear();
        } else {
            contact.update(open);
            timer.ask(open.until() + timeToLive, context.timerService());
        }
    }
}
