package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;

/** Creates dead letters: the original record for {@code <topic>.dead}, with the reason in its headers. */
final class DeadLetterRecords {
    /** Header {@code dead-stage}. */
    static final String STAGE = "control-plane";

    private DeadLetterRecords() {}

    static Record<String, OutputRecord> of(
            Record<String, byte[]> record, RecordOrigin origin, Reason reason, String message) {
        OutputRecord outgoing = new OutputRecord(Topics.dead(origin.topic()), record.value());
        Record<String, OutputRecord> dead = new Record<>(record.key(), outgoing, record.timestamp(), record.headers());
        new DeadLetter(reason, message, STAGE, origin.toString())
                .headers()
                .forEach((name, value) -> dead.headers().add(name, value.getBytes(StandardCharsets.UTF_8)));
        return dead;
    }
}
