package io.furrow.control.manager;

import java.time.Duration;
import java.util.function.BiFunction;
import java.util.function.Supplier;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.control.audit.AuditEntry;
import io.furrow.model.control.Command;
import io.furrow.model.control.Received;
import io.furrow.model.control.RefusedException;
import io.furrow.model.control.Requests;
import io.furrow.model.control.Response;
import io.furrow.model.topic.Topics;

/**
 * Gives every request one effect and one answer. The time is that of the control plane's clock, because commands are about now,
 * whatever the record's timestamp says.
 *
 * <p><b>State</b>: {@link AnsweredRequests}, and what the desk remembers. <b>Twice</b>: a request whose id was answered is passed
 * over. <b>Emits</b>: what the desk writes, then the answer on the request's topic, its key the request's id, else the
 * request's key, and an entry on {@code service.audit}; all in one transaction.
 *
 * @param <C> commands of the manager
 */
public final class AnswerRequests<C extends Command> extends ContextualProcessor<String, byte[], String, Outgoing> {
    private static final Duration TICK = Duration.ofSeconds(1);

    private final ManagerTopic<C> manager;
    private final Duration remembered;
    private final BiFunction<ProcessorContext<?, ?>, Outbox, Desk<C>> opening;
    private AnsweredRequests answered;
    private Desk<C> desk;
    private boolean opened;

    /**
     * @param remembered how long ids of requests are
     * @param opening makes the desk, whose stores are those of the context
     */
    public AnswerRequests(
            ManagerTopic<C> manager, Duration remembered, BiFunction<ProcessorContext<?, ?>, Outbox, Desk<C>> opening) {
        this.manager = manager;
        this.remembered = remembered;
        this.opening = opening;
    }

    @Override
    public void init(ProcessorContext<String, Outgoing> context) {
        super.init(context);
        answered = new AnsweredRequests(context, manager.answers(), remembered);
        desk = opening.apply(context, outbox(context));
        opened = false;
        context.schedule(TICK, PunctuationType.WALL_CLOCK_TIME, desk::passTime);
    }

    /** Where desks write to: on to the next node, under the time of the control plane's clock. */
    public static Outbox outbox(ProcessorContext<String, Outgoing> context) {
        return (topic, key, value) ->
                context.forward(new Record<>(key, new Outgoing(topic, value), context.currentSystemTimeMs()));
    }

    @Override
    public void process(Record<String, byte[]> record) {
        long now = context().currentSystemTimeMs();
        if (!opened) {
            desk.passTime(now);
            opened = true;
        }
        Received<C> received = manager.read(record.value());
        if (received instanceof Received.Request<C> request) {
            answerOnce(request.requestId(), record, () -> answer(request.command(), now));
        } else if (received instanceof Received.Refused<C> refused) {
            answerOnce(refused.requestId(), record, refused::answer);
        }
    }

    private void answerOnce(String requestId, Record<String, byte[]> record, Supplier<Response> answer) {
        long now = context().currentSystemTimeMs();
        if (answered.has(requestId, now)) {
            return;
        }
        Response given = answer.get().to(requestId);
        byte[] response = given.toBytes();
        answered.add(requestId, response, now);
        String ownKey = record.key() == null || record.key().isEmpty() ? null : record.key();
        outbox(context()).put(manager.topic(), requestId == null ? ownKey : requestId, response);
        AuditEntry entry = AuditEntry.of(manager.topic(), record.value(), given, now);
        outbox(context()).put(Topics.AUDIT, requestId == null ? ownKey : requestId, entry.toBytes());
    }

    private Response answer(C command, long now) {
        try {
            return desk.answer(command, now);
        } catch (RefusedException e) {
            return Requests.refusal(e, command);
        }
    }
}
