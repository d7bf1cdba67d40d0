package io.furrow.control.rest;

import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.RecordTooLargeException;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.control.audit.AuditEntry;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Response;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/**
 * Asks the managers over their topics, whichever instance they run in, and waits for the answer. The same request id twice is
 * one request: whoever has heard nothing may ask again.
 */
final class Managers implements AutoCloseable {
    private static final Duration CLOSING = Duration.ofSeconds(5);

    private final Answers answers;
    private final ServiceView view;
    private final Duration patience;
    private final Executor executor;
    private final Producer<String, byte[]> producer;

    /** A command to a manager. @param members of the request but its type, command, id and user */
    record Question(String topic, String command, ObjectNode members) {}

    /** @param executor answers are handed on by it */
    Managers(Properties client, Answers answers, ServiceView view, Duration patience, Executor executor) {
        this.answers = answers;
        this.view = view;
        this.patience = patience;
        this.executor = executor;
        Properties settings = new Properties();
        settings.putAll(client);
        settings.put("max.block.ms", Long.toString(patience.toMillis()));
        settings.put("request.timeout.ms", Long.toString(patience.toMillis()));
        settings.put("delivery.timeout.ms", Long.toString(patience.toMillis()));
        settings.put("linger.ms", "0");
        settings.put("max.request.size", Integer.toString(16 * 1024 * 1024));
        this.producer = new KafkaProducer<>(settings, new StringSerializer(), new ByteArraySerializer());
    }

    /**
     * The answer of a manager, also where it refuses; a {@link ProblemException} where there is none.
     *
     * @throws ProblemException where answers are not heard yet
     */
    CompletionStage<Response> ask(Question question, Caller caller) {
        if (!view.isComplete()) {
            throw ProblemException.notReady();
        }
        Answers.Key key = new Answers.Key(question.topic(), caller.requestId());
        CompletableFuture<Response> mine = new CompletableFuture<>();
        CompletableFuture<Response> first = answers.await(key, mine);
        if (first == null) {
            mine.orTimeout(patience.toMillis(), TimeUnit.MILLISECONDS)
                    .whenComplete((answer, failure) -> answers.forget(key, mine));
            answers.known(key).ifPresentOrElse(mine::complete, () -> send(question, caller, mine));
        }
        return (first == null ? mine : first)
                .handleAsync((answer, failure) -> heard(answer, failure, caller), executor);
    }

    private void send(Question question, Caller caller, CompletableFuture<Response> future) {
        ObjectNode request = question.members().deepCopy();
        request.put("type", "request")
                .put("requestId", caller.requestId())
                .put("command", question.command())
                .put(AuditEntry.USER, caller.user());
        try {
            byte[] value = NgsiJson.write(request);
            producer.send(new ProducerRecord<>(question.topic(), caller.requestId(), value), (at, failure) -> {
                if (failure != null) {
                    future.completeExceptionally(failure);
                }
            });
        } catch (UncheckedIOException e) { // half of a surrogate pair has no form in UTF-8
            future.completeExceptionally(new ProblemException(ErrorCode.NOT_JSON, "a text of the body is not Unicode"));
        } catch (KafkaException e) {
            future.completeExceptionally(e);
        }
    }

    private Response heard(Response answer, Throwable failure, Caller caller) {
        if (failure == null) {
            return answer;
        }
        if (failure instanceof ProblemException problem) {
            throw problem;
        }
        if (failure instanceof RecordTooLargeException) {
            throw new ProblemException(413, "too-large", "the request is larger than Kafka takes");
        }
        String why = failure instanceof TimeoutException
                ? "no manager answered within " + patience.toMillis() + " ms"
                : "Kafka does not take requests (" + failure.getMessage() + ")";
        throw new ProblemException(
                503,
                "not-answered",
                "%s; the request may still be carried out. Repeat it with the header %s: %s, which has one effect"
                        .formatted(why, Caller.KEY, caller.requestId()));
    }

    /** Puts what no manager knows of on the audit topic. */
    void audit(AuditEntry entry) {
        producer.send(new ProducerRecord<>(Topics.AUDIT, entry.toBytes()));
    }

    @Override
    public void close() {
        producer.close(CLOSING);
    }
}
