package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.common.header.Header;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.processor.api.RecordMetadata;

import io.furrow.model.control.Received;

/** Lets requests pass, and no responses, with a header that says from where on their topic they come; a missing key is empty. */
final class NoteOrigin extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final String HEADER = "request-origin";

    private final ManagerTopic<?> manager;

    /** Where a request is on its topic. */
    record Origin(String partition, long offset) {
        static Origin of(Record<?, ?> record) {
            Header header = record.headers().lastHeader(HEADER);
            String text = new String(header.value(), StandardCharsets.UTF_8);
            int at = text.lastIndexOf('@');
            return new Origin(text.substring(0, at), Long.parseLong(text.substring(at + 1)));
        }

        <K, V> void noteOn(Record<K, V> record) {
            record.headers().remove(HEADER);
            record.headers().add(HEADER, (partition + "@" + offset).getBytes(StandardCharsets.UTF_8));
        }
    }

    NoteOrigin(ManagerTopic<?> manager) {
        this.manager = manager;
    }

    @Override
    public void process(Record<String, byte[]> record) {
        if (manager.read(record.value()) instanceof Received.Passed) {
            return;
        }
        RecordMetadata at = context().recordMetadata().orElseThrow();
        Record<String, byte[]> request = record.withKey(record.key() == null ? "" : record.key());
        new Origin(at.topic() + "-" + at.partition(), at.offset()).noteOn(request);
        context().forward(request);
    }
}
