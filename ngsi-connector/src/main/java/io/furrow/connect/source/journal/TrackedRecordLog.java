package io.furrow.connect.source.journal;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.repair.RecordTracker;
import io.furrow.connect.repair.TrackedRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;

/** Notifies the repair about records that arrive by notification. */
public final class TrackedRecordLog implements RecordLog {
    /** The entities that the repair tracks; thread-safe. */
    public interface Entities {
        boolean covers(FiwareScope scope);

        /** A record of an entity was appended to the topic. */
        void note(String identity, boolean gone);
    }

    private final JournalRecordLog recordLog;
    private final RecordTracker live;
    private final Entities entities;

    public TrackedRecordLog(JournalRecordLog recordLog, RecordTracker live, Entities entities) {
        this.recordLog = recordLog;
        this.live = live;
        this.entities = entities;
    }

    @Override
    public Optional<CompletableFuture<Void>> take(List<KafkaRecord> records) {
        String subscription = "";
        List<KafkaRecord> events = new ArrayList<>(records.size());
        List<TrackedRecord> covered = new ArrayList<>(records.size());
        for (KafkaRecord record : records) {
            if (record.version() != null) {
                FiwareScope scope = scope(record.headers());
                subscription = subscription(record.headers());
                if (entities.covers(scope)) {
                    events.add(record);
                    covered.add(entity(record));
                }
            }
        }
        List<byte[]> payloads = records.stream().map(JournalRecordCodec::write).toList();
        return live.append(subscription, covered, () -> recordLog.append(payloads))
                .map(durable -> durable.thenRun(() -> events.forEach(this::note)));
    }

    private void note(KafkaRecord record) {
        entities.note(identity(record), record.value() == null);
    }

    private static TrackedRecord entity(KafkaRecord record) {
        return new TrackedRecord(
                identity(record),
                record.headers().get(HeaderNames.CE_ID),
                record.version().modified(),
                record.value() == null);
    }

    private static String identity(KafkaRecord record) {
        return scope(record.headers()).identity(record.version().type(), record.key());
    }

    private static String subscription(Map<String, String> headers) {
        String source = headers.get(HeaderNames.CE_SOURCE);
        return source.substring(source.lastIndexOf('/') + 1);
    }

    private static FiwareScope scope(Map<String, String> headers) {
        return new FiwareScope(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH));
    }
}
