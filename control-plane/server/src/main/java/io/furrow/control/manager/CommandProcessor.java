package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Optional;
import java.util.OptionalLong;
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
 * Executes every request once and answers it once. The time is that of the control plane's clock, because commands take
 * effect now, regardless of the record's timestamp. A request that makes the manager fail changes nothing, is answered
 * with {@link ErrorCode#INTERNAL_ERROR} and becomes a dead letter.
 *
 * <p><b>State</b>: {@link RequestLog}, and the handler's stores. <b>Duplicates</b>: a request whose id was answered is
 * skipped; another request with that id is rejected. <b>Dry runs</b>: answered and audited, the handler's writes are
 * discarded. <b>Emits</b>: the handler's records, then the answer on the
 * request's topic, keyed by the request's id, else by the request's key, and an entry on {@code service.audit}; all in
 * one transaction.
 *
 * @param <C> commands of the manager
 */
final class CommandProcessor<C extends Command> extends ContextualProcessor<String, byte[], String, OutputRecord> {
    private static final Logger LOG = LoggerFactory.getLogger(CommandProcessor.class);
    private static final Duration TICK = Duration.ofSeconds(1);
    private static final Duration STEP = Duration.ofMillis(100);

    private final ManagerTopic<C> manager;
    private final Duration requestRetention;
    private final Function<UnitOfWork, CommandHandler<C>> handlerFactory;
    private RequestLog requestLog;
    private UnitOfWork unitOfWork;
    private Punctuations punctuations;
    private CommandHandler<C> handler;
    private boolean started;

    /**
     * @param requestRetention how long ids of requests are stored for deduplication
     * @param handlerFactory creates the handler on the stores of the context
     */
    CommandProcessor(
            ManagerTopic<C> manager,
            Duration requestRetention,
            Function<UnitOfWork, CommandHandler<C>> handlerFactory) {
        this.manager = manager;
        this.requestRetention = requestRetention;
        this.handlerFactory = handlerFactory;
    }

    @Override
    public void init(ProcessorContext<String, OutputRecord> context) {
        super.init(context);
        requestLog = new RequestLog(context, manager.answers(), requestRetention);
        unitOfWork = new UnitOfWork(context);
        handler = handlerFactory.apply(unitOfWork);
        started = false;
        punctuations = new Punctuations(unitOfWork, context.taskId());
        context.schedule(TICK, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(handler.due(now)));
        context.schedule(STEP, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(handler.pending(now)));
    }

    @Override
    public void process(Record<String, byte[]> record) {
        long now = context().currentSystemTimeMs();
        if (!started) {
            punctuations.run(handler.due(now));
            started = true;
        }
        long oversized = RequestProcessor.oversizedBytes(record);
        if (oversized > 0) {
            rejectOversized(record, oversized, now);
            return;
        }
        ParsedRequest<C> parsed = manager.read(record.value());
        if (parsed instanceof ParsedRequest.Request<C> request) {
            answerOnce(IdentifiedRequest.of(record, request.requestId()), () -> answer(record, request, now), now);
        } else if (parsed instanceof ParsedRequest.Refused<C> rejected) {
            answerOnce(IdentifiedRequest.of(record, rejected.requestId()), rejected::answer, now);
        }
    }

    /** A request with its id, which may be null, and its fingerprint. */
    private record IdentifiedRequest(Record<String, byte[]> record, String id, String fingerprint) {
        static IdentifiedRequest of(Record<String, byte[]> record, String id) {
            return new IdentifiedRequest(record, id, id == null ? "" : RequestFingerprint.of(record.value()));
        }
    }

    private interface ResponseSupplier {
        CommandResult answer();
    }

    private void answerOnce(IdentifiedRequest identified, ResponseSupplier supplier, long now) {
        String id = identified.id();
        Optional<String> existing = id == null ? Optional.empty() : requestLog.fingerprint(id, now);
        if (existing.isPresent()) {
            if (!existing.get().equals(identified.fingerprint())) {
                send(
                        identified,
                        rejection(identified, ErrorCode.REQUEST_ID_REUSED, "this id was given to another request"),
                        now);
            }
            return;
        }
        if (id != null && requestLog.isFull(now)) {
            String reason =
                    "the ids of %d requests of the last %d min are stored, which is the maximum; try again later"
                            .formatted(Limits.REMEMBERED_REQUESTS, requestRetention.toMinutes());
            send(identified, rejection(identified, ErrorCode.OVERLOADED, reason), now);
            return;
        }
        CommandResult result = supplier.answer();
        if (id != null) {
            requestLog.add(id, identified.fingerprint(), now);
        }
        send(identified, result, now);
    }

    private void rejectOversized(Record<String, byte[]> record, long bytes, long now) {
        RequestSummary summary = RequestSummary.of(record.value());
        String reason =
                "the request has %d bytes, and may have %d; send a long list of devices in several with 'add-devices'"
                        .formatted(bytes, Limits.REQUEST_BYTES);
        answerOnce(
                IdentifiedRequest.of(record, summary.requestId()),
                () -> summary.refusal(ErrorCode.TOO_LARGE, reason),
                now);
    }

    private static CommandResult rejection(IdentifiedRequest identified, ErrorCode code, String reason) {
        return RequestSummary.of(identified.record().value()).refusal(code, reason);
    }

    private void send(IdentifiedRequest identified, CommandResult result, long now) {
        String id = identified.id();
        String ownKey =
                identified.record().key() == null || identified.record().key().isEmpty()
                        ? null
                        : identified.record().key();
        String key = id == null ? ownKey : id;
        CommandResult answer = result.to(id);
        Record<String, OutputRecord> response = new Record<>(
                key,
                new OutputRecord(manager.topic(), answer.toBytes()),
                context().currentSystemTimeMs());
        if (id != null) {
            response.headers()
                    .add(RequestFingerprint.HEADER, identified.fingerprint().getBytes(StandardCharsets.UTF_8));
        }
        context().forward(response);
        byte[] entry = AuditEntry.of(manager.topic(), identified.record().value(), answer, now)
                .toBytes();
        context().forward(new Record<>(key, new OutputRecord(Topics.AUDIT, entry), response.timestamp()));
    }

    private CommandResult answer(Record<String, byte[]> record, ParsedRequest.Request<C> request, long now) {
        UnitOfWork.Work<CommandResult, RejectedException> work = () -> {
            requireSequence(request);
            return handler.answer(request.command(), now);
        };
        return request.dryRun()
                ? answer(record, request.command(), () -> unitOfWork.preview(work))
                        .ofDryRun()
                : answer(record, request.command(), () -> unitOfWork.call(work));
    }

    private void requireSequence(ParsedRequest.Request<C> request) throws RejectedException {
        if (request.ifSequence() == null) {
            return;
        }
        OptionalLong existing = handler.sequenceOf(request.command());
        if (!existing.equals(OptionalLong.of(request.ifSequence()))) {
            throw new RejectedException(
                    ErrorCode.OUTDATED,
                    "%s, not the sequence %d of the request; read it again"
                            .formatted(
                                    existing.isPresent()
                                            ? "it has the sequence " + existing.getAsLong()
                                            : "it has none",
                                    request.ifSequence()));
        }
    }

    private CommandResult answer(
            Record<String, byte[]> record, C command, UnitOfWork.Work<CommandResult, RejectedException> work) {
        try {
            return work.run();
        } catch (RejectedException e) {
            return Requests.refusal(e, command);
        } catch (OversizedRecordException e) {
            return Requests.refusal(new RejectedException(ErrorCode.TOO_LARGE, e.getMessage()), command);
        } catch (RuntimeException e) { // a bug must not block the other requests
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
