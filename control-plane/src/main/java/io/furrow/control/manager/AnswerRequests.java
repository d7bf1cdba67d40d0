package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Optional;
import java.util.function.BiFunction;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.audit.AuditEntry;
import io.furrow.model.control.Command;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.Received;
import io.furrow.model.control.RefusedException;
import io.furrow.model.control.RequestExcerpt;
import io.furrow.model.control.RequestFingerprint;
import io.furrow.model.control.Requests;
import io.furrow.model.control.Response;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;

/**
 * Gives every request one effect and one answer. The time is that of the control plane's clock, because commands are about now,
 * whatever the record's timestamp says. A request that makes the manager fail changes nothing, is answered with {@link
 * ErrorCode#INTERNAL_ERROR} and becomes a dead letter.
 *
 * <p><b>State</b>: {@link AnsweredRequests}, and what the desk remembers. <b>Twice</b>: a request whose id was answered is passed
 * over; another request under that id is refused. <b>Emits</b>: what the desk writes, then the answer on the request's topic, its
 * key the request's id, else the request's key, and an entry on {@code service.audit}; all in one transaction.
 *
 * @param <C> commands of the manager
 */
public final class AnswerRequests<C extends Command> extends ContextualProcessor<String, byte[], String, Outgoing> {
    private static final Logger LOG = LoggerFactory.getLogger(AnswerRequests.class);
    private static final Duration TICK = Duration.ofSeconds(1);
    private static final Duration STEP = Duration.ofMillis(100);

    private final ManagerTopic<C> manager;
    private final Duration remembered;
    private final BiFunction<ProcessorContext<?, ?>, Outbox, Desk<C>> opening;
    private AnsweredRequests answered;
    private AtomicContext atomic;
    private Punctuations punctuations;
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
        atomic = new AtomicContext(context);
        desk = opening.apply(atomic, outbox(atomic));
        opened = false;
        punctuations = new Punctuations(atomic);
        context.schedule(TICK, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(desk.due(now)));
        context.schedule(STEP, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(desk.pending(now)));
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
            punctuations.run(desk.due(now));
            opened = true;
        }
        long oversized = AcceptRequests.oversizedBytes(record);
        if (oversized > 0) {
            refuseOversized(record, oversized, now);
            return;
        }
        Received<C> received = manager.read(record.value());
        if (received instanceof Received.Request<C> request) {
            answerOnce(Asked.of(record, request.requestId()), () -> answer(record, request.command(), now), now);
        } else if (received instanceof Received.Refused<C> refused) {
            answerOnce(Asked.of(record, refused.requestId()), refused::answer, now);
        }
    }

    /** A request as a record, its id, which may be null, and what it asks for. */
    private record Asked(Record<String, byte[]> record, String id, String fingerprint) {
        static Asked of(Record<String, byte[]> record, String id) {
            return new Asked(record, id, id == null ? "" : RequestFingerprint.of(record.value()));
        }
    }

    private interface Answering {
        Response answer();
    }

    private void answerOnce(Asked asked, Answering answering, long now) {
        String id = asked.id();
        Optional<String> known = id == null ? Optional.empty() : answered.fingerprint(id, now);
        if (known.isPresent()) {
            // Of requests that an earlier version answered the fingerprint is not known, but the answer.
            boolean same =
                    known.get().equals(asked.fingerprint()) || known.get().startsWith("{");
            if (!same) {
                send(asked, refusal(asked, ErrorCode.REQUEST_ID_REUSED, "this id was given to another request"), now);
            }
            return;
        }
        if (id != null && answered.isFull(now)) {
            String reason = "%d requests of the last %d min are remembered, which is the most; ask again later"
                    .formatted(Limits.REMEMBERED_REQUESTS, remembered.toMinutes());
            send(asked, refusal(asked, ErrorCode.OVERLOADED, reason), now);
            return;
        }
        Response given = answering.answer();
        if (id != null) {
            answered.add(id, asked.fingerprint(), now);
        }
        send(asked, given, now);
    }

    private void refuseOversized(Record<String, byte[]> record, long bytes, long now) {
        RequestExcerpt excerpt = RequestExcerpt.of(record.value());
        String reason =
                "the request has %d bytes, and may have %d; send a long list of devices in several with 'add-devices'"
                        .formatted(bytes, Limits.REQUEST_BYTES);
        answerOnce(Asked.of(record, excerpt.requestId()), () -> excerpt.refusal(ErrorCode.TOO_LARGE, reason), now);
    }

    private static Response refusal(Asked asked, ErrorCode code, String reason) {
        return RequestExcerpt.of(asked.record().value()).refusal(code, reason);
    }

    private void send(Asked asked, Response given, long now) {
        String id = asked.id();
        String ownKey = asked.record().key() == null || asked.record().key().isEmpty()
                ? null
                : asked.record().key();
        String key = id == null ? ownKey : id;
        Response answer = given.to(id);
        Record<String, Outgoing> response = new Record<>(
                key, new Outgoing(manager.topic(), answer.toBytes()), context().currentSystemTimeMs());
        if (id != null) {
            response.headers()
                    .add(RequestFingerprint.HEADER, asked.fingerprint().getBytes(StandardCharsets.UTF_8));
        }
        context().forward(response);
        AuditEntry entry = AuditEntry.of(manager.topic(), asked.record().value(), answer, now);
        outbox(context()).put(Topics.AUDIT, key, entry.toBytes());
    }

    private Response answer(Record<String, byte[]> record, C command, long now) {
        try {
            return atomic.call(() -> desk.answer(command, now));
        } catch (RefusedException e) {
            return Requests.refusal(e, command);
        } catch (OversizedRecordException e) {
            return Requests.refusal(new RefusedException(ErrorCode.TOO_LARGE, e.getMessage()), command);
        } catch (RuntimeException e) { // a fault of ours, which must not keep the other requests from being answered
            RecordOrigin origin = RecordOrigin.of(record).orElseThrow();
            LOG.error("the request {} failed and changed nothing; it is a dead letter", origin, e);
            context().forward(DeadLetters.of(record, origin, Reason.FAILED, e.toString()));
            return Requests.refusal(
                    new RefusedException(
                            ErrorCode.INTERNAL_ERROR, "the manager failed at it and changed nothing; its log says why"),
                    command);
        }
    }
}
