package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.Limits;
import io.furrow.model.control.ParsedRequest;
import io.furrow.model.control.RequestSummary;

/**
 * Forwards the requests on a manager's topic, not its responses, with their position in headers; a missing key becomes
 * empty. Of a request that is larger than {@link Limits#REQUEST_BYTES} only what its rejection needs is forwarded, with a
 * header that says so.
 */
final class RequestProcessor extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final String OVERSIZED = "request-bytes";

    private final ManagerTopic<?> manager;

    RequestProcessor(ManagerTopic<?> manager) {
        this.manager = manager;
    }

    /** How many bytes an oversized request had; 0 for one that was not. */
    static long oversizedBytes(Record<?, ?> record) {
        String bytes = KafkaClients.text(record.headers(), OVERSIZED);
        return bytes == null ? 0 : Long.parseLong(bytes);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        record.headers().remove(OVERSIZED);
        if (record.value() != null && record.value().length > Limits.REQUEST_BYTES) {
            refuse(record);
        } else if (!(manager.read(record.value()) instanceof ParsedRequest.Passed)) {
            forward(record);
        }
    }

    private void refuse(Record<String, byte[]> record) {
        RequestSummary excerpt = RequestSummary.of(record.value());
        if (!excerpt.isResponse()) {
            byte[] bytes = Integer.toString(record.value().length).getBytes(StandardCharsets.UTF_8);
            record.headers().add(OVERSIZED, bytes);
            forward(record.withValue(excerpt.toBytes()));
        }
    }

    private void forward(Record<String, byte[]> record) {
        Record<String, byte[]> request = record.withKey(record.key() == null ? "" : record.key());
        context().forward(RecordOrigin.of(context()).noteOn(request));
    }
}
