package io.furrow.control.rest.view;

import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
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
 * Asks the managers over their topics, whichever instance they run in, and waits for the answer. The same request id twice is
 * one request: whoever has heard nothing may ask again. No thread waits meanwhile, and no more than {@value #MAX_AWAITED} requests.
 */
public final class CommandClient implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(CommandClient.class);
    private static final int MAX_AWAITED = 2000;

    private final PendingReplies answers;
    private final StateView view;
    private final Duration timeout;
    private final Executor executor;
    private final RecordSender sender;

    /** A command to a manager. @param members of the request but its type, command, id and user */
    public record CommandRequest(String topic, String command, ObjectNode members) {}

    /** @param executor answers are forwarded by it */
    public CommandClient(
            Properties client, PendingReplies answers, StateView view, Duration timeout, Executor executor) {
        this.answers = answers;
        this.view = view;
        this.timeout = timeout;
        this.executor = executor;
        this.sender = new RecordSender(client, timeout);
    }

    /**
     * The answer of a manager, also where it refuses; a {@link ProblemException} if there is none.
     *
     * @throws ProblemException where answers are not heard yet, the id was given to another request, or too many wait already
     */
    public CompletionStage<CommandResult> request(CommandRequest question, RequestContext caller) {
        if (!view.isComplete()) {
            throw ProblemException.notReady();
        }
        byte[] value = value(message(question, caller));
        PendingReplies.Key key = new PendingReplies.Key(question.topic(), caller.requestId());
        PendingReplies.Awaited mine =
                new PendingReplies.Awaited(RequestFingerprint.of(value), new CompletableFuture<>());
        PendingReplies.Awaited first = answers.await(key, mine);
        if (first == null) {
            begin(key, mine, value);
        } else if (!first.fingerprint().equals(mine.fingerprint())) {
            throw ProblemException.keyReused();
        }
        return (first == null ? mine : first)
                .future()
                .handleAsync((answer, failure) -> heard(answer, failure, caller), executor);
    }

    private void begin(PendingReplies.Key key, PendingReplies.Awaited mine, byte[] value) {
        CompletableFuture<CommandResult> future = mine.future();
        future.orTimeout(timeout.toMillis(), TimeUnit.MILLISECONDS)
                .whenComplete((answer, failure) -> answers.forget(key, mine));
        try {
            if (answers.awaited() > MAX_AWAITED) {
                throw ProblemException.overloaded();
            }
            answers.find(key, mine.fingerprint())
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

    private static ObjectNode message(CommandRequest question, RequestContext caller) {
        ObjectNode request = question.members().deepCopy();
        return request.put("type", "request")
                .put("requestId", caller.requestId())
                .put("command", question.command())
                .put(AuditEntry.USER, caller.user());
    }

    private static byte[] value(ObjectNode request) {
        byte[] value;
        try {
            value = NgsiJson.write(request);
        } catch (UncheckedIOException e) { // half of a surrogate pair has no form in UTF-8
            throw new ProblemException(ErrorCode.NOT_JSON, "a text of the body is not Unicode");
        }
        if (value.length > Limits.REQUEST_BYTES) {
            throw ProblemException.tooLarge(value.length, Limits.REQUEST_BYTES);
        }
        return value;
    }

    private CommandResult heard(CommandResult answer, Throwable failure, RequestContext caller) {
        if (failure == null) {
            return answer;
        }
        Throwable cause =
                failure instanceof CompletionException && failure.getCause() != null ? failure.getCause() : failure;
        if (cause instanceof ProblemException problem) {
            throw problem;
        }
        ProblemException.refuseIf(
                cause instanceof RecordTooLargeException,
                ErrorCode.TOO_LARGE,
                "the request is larger than Kafka takes");
        String why = cause instanceof TimeoutException
                ? "no manager answered within " + timeout.toMillis() + " ms"
                : "Kafka does not take requests (" + FailureText.of(cause) + ")";
        throw new ProblemException(
                503,
                "not-answered",
                "%s; the request may still be carried out. Repeat it with the header %s: %s, which has one effect"
                        .formatted(why, RequestContext.KEY, caller.requestId()));
    }

    /** Puts what no manager knows of on the audit topic. */
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
