package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.Limits;
import io.furrow.model.control.ParsedRequest;
import io.furrow.model.control.RequestSummary;

/**
 * Forwards the requests on a manager's topic, not its responses, with their origin in headers; a missing key becomes
 * empty. A request larger than {@link Limits#REQUEST_BYTES} is reduced to what its rejection needs, with its size in a
 * header.
 */
final class RequestProcessor extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final String OVERSIZED = "request-bytes";

    private final ManagerTopic<?> manager;

    RequestProcessor(ManagerTopic<?> manager) {
        this.manager = manager;
    }

    /** Returns the size of an oversized request; 0 for other requests. */
    static long oversizedBytes(Record<?, ?> record) {
        String bytes = KafkaClients.text(record.headers(), OVERSIZED);
        return bytes == null ? 0 : Long.parseLong(bytes);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        record.headers().remove(OVERSIZED);
        if (record.value() != null && record.value().length > Limits.REQUEST_BYTES) {
            forwardSummary(record);
        } else if (!(manager.read(record.value()) instanceof ParsedRequest.Passed)) {
            forward(record);
        }
    }

    private void forwardSummary(Record<String, byte[]> record) {
        RequestSummary summary = RequestSummary.of(record.value());
        if (!summary.isResponse()) {
            byte[] bytes = Integer.toString(record.value().length).getBytes(StandardCharsets.UTF_8);
            record.headers().add(OVERSIZED, bytes);
            forward(record.withValue(summary.toBytes()));
        }
    }

    private void forward(Record<String, byte[]> record) {
        Record<String, byte[]> request = record.withKey(record.key() == null ? "" : record.key());
        context().forward(RecordOrigin.of(context()).addTo(request));
    }
}
