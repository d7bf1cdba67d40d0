package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Optional;
import java.util.function.Function;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.audit.AuditEntry;
import io.furrow.model.control.Command;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.ParsedRequest;
import io.furrow.model.control.RejectedException;
import io.furrow.model.control.RequestFingerprint;
import io.furrow.model.control.RequestSummary;
import io.furrow.model.control.Requests;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Gives every request one effect and one answer. The time is that of the control plane's clock, because commands are about now,
 * whatever the record's timestamp says. A request that makes the manager fail changes nothing, is answered with {@link
 * ErrorCode#INTERNAL_ERROR} and becomes a dead letter.
 *
 * <p><b>State</b>: {@link RequestLog}, and what the handler remembers. <b>Twice</b>: a request whose id was answered is passed
 * over; another request under that id is refused. <b>Emits</b>: what the handler writes, then the answer on the request's topic, its
 * key the request's id, else the request's key, and an entry on {@code service.audit}; all in one transaction.
 *
 * @param <C> commands of the manager
 */
final class CommandProcessor<C extends Command> extends ContextualProcessor<String, byte[], String, OutputRecord> {
    private static final Logger LOG = LoggerFactory.getLogger(CommandProcessor.class);
    private static final Duration TICK = Duration.ofSeconds(1);
    private static final Duration STEP = Duration.ofMillis(100);

    private final ManagerTopic<C> manager;
    private final Duration remembered;
    private final Function<UnitOfWork, CommandHandler<C>> opening;
    private RequestLog answered;
    private UnitOfWork unitOfWork;
    private Punctuations punctuations;
    private CommandHandler<C> handler;
    private boolean opened;

    /**
     * @param remembered how long ids of requests are
     * @param opening makes the handler, whose stores are those of the context
     */
    CommandProcessor(ManagerTopic<C> manager, Duration remembered, Function<UnitOfWork, CommandHandler<C>> opening) {
        this.manager = manager;
        this.remembered = remembered;
        this.opening = opening;
    }

    @Override
    public void init(ProcessorContext<String, OutputRecord> context) {
        super.init(context);
        answered = new RequestLog(context, manager.answers(), remembered);
        unitOfWork = new UnitOfWork(context);
        handler = opening.apply(unitOfWork);
        opened = false;
        punctuations = new Punctuations(unitOfWork, context.taskId());
        context.schedule(TICK, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(handler.due(now)));
        context.schedule(STEP, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(handler.pending(now)));
    }

    @Override
    public void process(Record<String, byte[]> record) {
        long now = context().currentSystemTimeMs();
        if (!opened) {
            punctuations.run(handler.due(now));
            opened = true;
        }
        long oversized = RequestProcessor.oversizedBytes(record);
        if (oversized > 0) {
            refuseOversized(record, oversized, now);
            return;
        }
        ParsedRequest<C> received = manager.read(record.value());
        if (received instanceof ParsedRequest.Request<C> request) {
            answerOnce(
                    IdentifiedRequest.of(record, request.requestId()),
                    () -> answer(record, request.command(), now),
                    now);
        } else if (received instanceof ParsedRequest.Refused<C> refused) {
            answerOnce(IdentifiedRequest.of(record, refused.requestId()), refused::answer, now);
        }
    }

    /** A request as a record, its id, which may be null, and what it asks for. */
    private record IdentifiedRequest(Record<String, byte[]> record, String id, String fingerprint) {
        static IdentifiedRequest of(Record<String, byte[]> record, String id) {
            return new IdentifiedRequest(record, id, id == null ? "" : RequestFingerprint.of(record.value()));
        }
    }

    private interface ResponseSupplier {
        CommandResult answer();
    }

    private void answerOnce(IdentifiedRequest requested, ResponseSupplier answering, long now) {
        String id = requested.id();
        Optional<String> existing = id == null ? Optional.empty() : answered.fingerprint(id, now);
        if (existing.isPresent()) {
            if (!existing.get().equals(requested.fingerprint())) {
                send(
                        requested,
                        refusal(requested, ErrorCode.REQUEST_ID_REUSED, "this id was given to another request"),
                        now);
            }
            return;
        }
        if (id != null && answered.isFull(now)) {
            String reason = "%d requests of the last %d min are remembered, which is the most; ask again later"
                    .formatted(Limits.REMEMBERED_REQUESTS, remembered.toMinutes());
            send(requested, refusal(requested, ErrorCode.OVERLOADED, reason), now);
            return;
        }
        CommandResult given = answering.answer();
        if (id != null) {
            answered.add(id, requested.fingerprint(), now);
        }
        send(requested, given, now);
    }

    private void refuseOversized(Record<String, byte[]> record, long bytes, long now) {
        RequestSummary excerpt = RequestSummary.of(record.value());
        String reason =
                "the request has %d bytes, and may have %d; send a long list of devices in several with 'add-devices'"
                        .formatted(bytes, Limits.REQUEST_BYTES);
        answerOnce(
                IdentifiedRequest.of(record, excerpt.requestId()),
                () -> excerpt.refusal(ErrorCode.TOO_LARGE, reason),
                now);
    }

    private static CommandResult refusal(IdentifiedRequest requested, ErrorCode code, String reason) {
        return RequestSummary.of(requested.record().value()).refusal(code, reason);
    }

    private void send(IdentifiedRequest requested, CommandResult given, long now) {
        String id = requested.id();
        String ownKey =
                requested.record().key() == null || requested.record().key().isEmpty()
                        ? null
                        : requested.record().key();
        String key = id == null ? ownKey : id;
        CommandResult answer = given.to(id);
        Record<String, OutputRecord> response = new Record<>(
                key,
                new OutputRecord(manager.topic(), answer.toBytes()),
                context().currentSystemTimeMs());
        if (id != null) {
            response.headers()
                    .add(RequestFingerprint.HEADER, requested.fingerprint().getBytes(StandardCharsets.UTF_8));
        }
        context().forward(response);
        byte[] entry = AuditEntry.of(manager.topic(), requested.record().value(), answer, now)
                .toBytes();
        context().forward(new Record<>(key, new OutputRecord(Topics.AUDIT, entry), response.timestamp()));
    }

    private CommandResult answer(Record<String, byte[]> record, C command, long now) {
        try {
            return unitOfWork.call(() -> handler.answer(command, now));
        } catch (RejectedException e) {
            return Requests.refusal(e, command);
        } catch (OversizedRecordException e) {
            return Requests.refusal(new RejectedException(ErrorCode.TOO_LARGE, e.getMessage()), command);
        } catch (RuntimeException e) { // a fault of ours, which must not keep the other requests from being answered
            RecordOrigin origin = RecordOrigin.of(record).orElseThrow();
            LOG.error("the request {} failed and changed nothing; it is a dead letter", origin, e);
            context().forward(DeadLetterRecords.of(record, origin, Reason.FAILED, FailureText.of(e)));
            return Requests.refusal(
                    new RejectedException(
                            ErrorCode.INTERNAL_ERROR, "the manager failed at it and changed nothing; its log says why"),
                    command);
        }
    }
}
