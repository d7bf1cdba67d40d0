package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.RecordTooLargeException;
import org.apache.kafka.common.errors.RetriableException;
import org.apache.kafka.common.errors.SerializationException;
import org.apache.kafka.common.header.Headers;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.streams.errors.DeserializationExceptionHandler;
import org.apache.kafka.streams.errors.ErrorHandlerContext;
import org.apache.kafka.streams.errors.ProcessingExceptionHandler;
import org.apache.kafka.streams.errors.ProductionExceptionHandler;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RequestSummary;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Handles failures of records in all Kafka Streams applications of the control plane: the record becomes a dead letter
 * and processing continues. {@link CommandProcessor} and {@link EventProcessor} handle their own failures atomically
 * and with an answer; this class handles the remaining ones. If Kafka itself failed, the thread is replaced and the
 * record is read again.
 */
public final class FailureHandler
        implements DeserializationExceptionHandler, ProcessingExceptionHandler, ProductionExceptionHandler {
    private static final Logger LOG = LoggerFactory.getLogger(FailureHandler.class);

    @Override
    public DeserializationExceptionHandler.Response handleError(
            ErrorHandlerContext context, ConsumerRecord<byte[], byte[]> record, Exception failure) {
        String source = KafkaClients.position(record);
        LOG.error("{} cannot be deserialized and is a dead letter", source, failure);
        return DeserializationExceptionHandler.Response.resume(List.of(deadLetter(
                record.topic(),
                record.key(),
                record.value(),
                record.headers(),
                new DeadLetter(Reason.NOT_AN_EVENT, FailureText.of(failure), DeadLetterRecords.STAGE, source))));
    }

    @Override
    public ProcessingExceptionHandler.Response handleError(
            ErrorHandlerContext context,
            org.apache.kafka.streams.processor.api.Record<?, ?> record,
            Exception failure) {
        if (isKafka(failure)) {
            return ProcessingExceptionHandler.Response.fail();
        }
        LOG.error("{} failed at {} and is a dead letter", context.processorNodeId(), source(context), failure);
        return ProcessingExceptionHandler.Response.resume(deadLetters(context, failure));
    }

    @Override
    public ProductionExceptionHandler.Response handleError(
            ErrorHandlerContext context, ProducerRecord<byte[], byte[]> record, Exception failure) {
        if (failure instanceof RetriableException) {
            return ProductionExceptionHandler.Response.retry();
        }
        LOG.error("a record for {} derived from {} cannot be written", record.topic(), source(context), failure);
        return ProductionExceptionHandler.Response.fail();
    }

    @Override
    @SuppressWarnings("rawtypes") // the interface declares the raw type
    public ProductionExceptionHandler.Response handleSerializationError(
            ErrorHandlerContext context,
            ProducerRecord record,
            Exception failure,
            SerializationExceptionOrigin origin) {
        LOG.error("a record for {} derived from {} cannot be serialized", record.topic(), source(context), failure);
        return ProductionExceptionHandler.Response.resume(deadLetters(context, failure));
    }

    @Override
    public void configure(Map<String, ?> configs) {
        // There are no options.
    }

    /** Whether the failure is one of Kafka, not of the record. */
    private static boolean isKafka(Throwable failure) {
        for (Throwable cause = failure; cause != null; cause = cause.getCause()) {
            if (cause instanceof RecordTooLargeException || cause instanceof SerializationException) {
                return false;
            }
            if (cause instanceof KafkaException) {
                return true;
            }
        }
        return false;
    }

    /** Returns the dead letter, and the answer if the record is a request; nothing for a punctuation, which has no record. */
    private static List<ProducerRecord<byte[], byte[]>> deadLetters(ErrorHandlerContext context, Exception failure) {
        RecordOrigin origin = origin(context);
        if (origin == null || context.sourceRawValue() == null) {
            return List.of();
        }
        List<ProducerRecord<byte[], byte[]>> deadLetters = new ArrayList<>();
        DeadLetter deadLetter =
                new DeadLetter(Reason.FAILED, FailureText.of(failure), DeadLetterRecords.STAGE, origin.toString());
        deadLetters.add(deadLetter(
                origin.topic(), context.sourceRawKey(), context.sourceRawValue(), context.headers(), deadLetter));
        if (ManagerTopic.isManager(origin.topic())) {
            deadLetters.add(answer(origin.topic(), context));
        }
        return deadLetters;
    }

    private static ProducerRecord<byte[], byte[]> answer(String topic, ErrorHandlerContext context) {
        RequestSummary summary = RequestSummary.of(context.sourceRawValue());
        CommandResult rejection = summary.refusal(
                ErrorCode.INTERNAL_ERROR,
                "the manager failed at it; its log says why, and the request is a dead letter");
        byte[] key = summary.requestId() == null ? null : summary.requestId().getBytes(StandardCharsets.UTF_8);
        byte[] value = rejection.to(summary.requestId()).toBytes();
        return new ProducerRecord<>(topic, null, context.timestamp(), key, value);
    }

    /** Returns the origin of the failed record; null if it has none on an external topic. */
    private static RecordOrigin origin(ErrorHandlerContext context) {
        boolean internal = context.topic() == null || context.topic().endsWith("-repartition");
        return RecordOrigin.of(context.headers())
                .orElse(internal ? null : new RecordOrigin(context.topic(), context.partition(), context.offset()));
    }

    private static String source(ErrorHandlerContext context) {
        return String.valueOf(origin(context));
    }

    private static ProducerRecord<byte[], byte[]> deadLetter(
            String topic, byte[] key, byte[] value, Headers original, DeadLetter deadLetter) {
        Headers headers = new RecordHeaders(original);
        deadLetter.headers().forEach((name, text) -> headers.add(name, text.getBytes(StandardCharsets.UTF_8)));
        return new ProducerRecord<>(Topics.dead(topic), null, null, key, value, headers);
    }
}
