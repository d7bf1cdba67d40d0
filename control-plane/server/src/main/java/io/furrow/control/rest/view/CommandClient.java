package io.furrow.control.rest.view;

import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.errors.RecordTooLargeException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.audit.AuditEntry;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RequestFingerprint;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Sends commands to the managers over their topics and returns their answers asynchronously. Requests with the same id
 * are one request, so that a client without an answer may repeat it. At most {@value #MAX_PENDING} requests wait for an
 * answer.
 */
public final class CommandClient implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(CommandClient.class);
    private static final int MAX_PENDING = 2000;

    private final PendingReplies answers;
    private final StateView view;
    private final Duration timeout;
    private final Executor executor;
    private final RecordSender sender;

    /** A command to a manager. @param members of the request, except type, command, id and user */
    public record CommandRequest(String topic, String command, ObjectNode members) {}

    /** @param executor completes the answers */
    public CommandClient(
            Properties client, PendingReplies answers, StateView view, Duration timeout, Executor executor) {
        this.answers = answers;
        this.view = view;
        this.timeout = timeout;
        this.executor = executor;
        this.sender = new RecordSender(client, timeout);
    }

    /**
     * Returns the answer of a manager, also a rejection; fails with a {@link ProblemException} if there is none.
     *
     * @throws ProblemException if answers are not read yet, the id was used for another request, or too many requests
     *     are waiting
     */
    public CompletionStage<CommandResult> request(CommandRequest command, RequestContext caller) {
        if (!view.isComplete()) {
            throw ProblemException.notReady();
        }
        byte[] value = value(message(command, caller));
        PendingReplies.Key key = new PendingReplies.Key(command.topic(), caller.requestId());
        PendingReplies.PendingRequest own =
                new PendingReplies.PendingRequest(RequestFingerprint.of(value), new CompletableFuture<>());
        PendingReplies.PendingRequest first = answers.await(key, own);
        if (first == null) {
            send(key, own, value);
        } else if (!first.fingerprint().equals(own.fingerprint())) {
            throw ProblemException.keyReused();
        }
        return (first == null ? own : first)
                .future()
                .handleAsync((answer, failure) -> result(answer, failure, caller), executor);
    }

    private void send(PendingReplies.Key key, PendingReplies.PendingRequest own, byte[] value) {
        CompletableFuture<CommandResult> future = own.future();
        future.orTimeout(timeout.toMillis(), TimeUnit.MILLISECONDS)
                .whenComplete((answer, failure) -> answers.forget(key, own));
        try {
            if (answers.pending() > MAX_PENDING) {
                throw ProblemException.overloaded();
            }
            answers.find(key, own.fingerprint())
                    .ifPresentOrElse(
                            future::complete,
                            () -> sender.send(
                                            new ProducerRecord<>(key.topic(), key.requestId(), value),
                                            () -> !future.isDone())
                                    .whenComplete((sent, failure) -> {
                                        if (failure != null) {
                                            future.completeExceptionally(failure);
                                        }
                                    }));
        } catch (ProblemException e) {
            future.completeExceptionally(e);
        }
    }

    private static ObjectNode message(CommandRequest command, RequestContext caller) {
        ObjectNode request = command.members().deepCopy();
        return request.put("type", "request")
                .put("requestId", caller.requestId())
                .put("command", command.command())
                .put(AuditEntry.USER, caller.user());
    }

    private static byte[] value(ObjectNode request) {
        byte[] value;
        try {
            value = NgsiJson.write(request);
        } catch (UncheckedIOException e) { // UTF-8 cannot encode half of a surrogate pair
            throw new ProblemException(ErrorCode.NOT_JSON, "a text of the body is not Unicode");
        }
        if (value.length > Limits.REQUEST_BYTES) {
            throw ProblemException.tooLarge(value.length, Limits.REQUEST_BYTES);
        }
        return value;
    }

    private CommandResult result(CommandResult answer, Throwable failure, RequestContext caller) {
        if (failure == null) {
            return answer;
        }
        Throwable cause = FailureText.unwrap(failure);
        if (cause instanceof ProblemException problem) {
            throw problem;
        }
        ProblemException.rejectIf(
                cause instanceof RecordTooLargeException,
                ErrorCode.TOO_LARGE,
                "the request is larger than Kafka accepts");
        String why = cause instanceof TimeoutException
                ? "no manager answered within " + timeout.toMillis() + " ms"
                : "Kafka does not accept requests (" + FailureText.of(cause) + ")";
        throw new ProblemException(
                503,
                "not-answered",
                "%s; the request may still be carried out. Repeat it with the header %s: %s, which has one effect"
                        .formatted(why, RequestContext.KEY, caller.requestId()));
    }

    /**
     * Audits a command that the API executes.
     *
     * @param about what it concerns, and its effects
     * @param result what it did
     * @param failure null if there is none
     */
    public void audit(
            RequestContext caller, String target, String command, ObjectNode about, String result, Throwable failure) {
        String error = failure instanceof ProblemException problem ? problem.error() : "internal-error";
        audit(new AuditEntry(
                System.currentTimeMillis(),
                caller.user(),
                target,
                command,
                about,
                failure == null ? result : CommandResult.ERROR,
                failure == null ? null : error,
                failure == null ? null : failure.getMessage(),
                caller.requestId()));
    }

    /** Audits a command that no manager executes. */
    public void audit(AuditEntry entry) {
        try {
            sender.send(new ProducerRecord<>(Topics.AUDIT, entry.toBytes()), () -> true)
                    .whenComplete((sent, failure) -> {
                        if (failure != null) {
                            notAudited(entry, failure);
                        }
                    });
        } catch (ProblemException e) {
            notAudited(entry, e);
        }
    }

    private static void notAudited(AuditEntry entry, Throwable failure) {
        LOG.error(
                "not on the audit topic: {} {} by {}, {}",
                entry.command(),
                entry.about(),
                entry.user(),
                entry.result(),
                failure);
    }

    @Override
    public void close() {
        sender.close();
    }
}
