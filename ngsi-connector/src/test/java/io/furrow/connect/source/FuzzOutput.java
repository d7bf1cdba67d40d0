package io.furrow.connect.source;

import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.CompletableFuture;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.repair.MissedChange;
import io.furrow.connect.repair.RepairOutput;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Makes the records of a repair as the source does, and says of which entities they are. Not safe for threads. */
public final class FuzzOutput implements RepairOutput {
    private static final NotificationTranslator.Settings SETTINGS =
            new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal", "max.record.bytes", "131072")).translation();

    /** Entities of which there is a record or a dead letter. */
    public final Set<String> told = new HashSet<>();
    /** Types of the entities of which there is a record without a value, by id. */
    public final Map<String, String> deleted = new HashMap<>();

    private final RepairRecordWriter records = new RepairRecordWriter(SETTINGS, null, new Ledger());

    @Override
    public byte[] serialize(String subscription, MissedChange finding) {
        return records.serialize(subscription, finding);
    }

    @Override
    public Optional<CompletableFuture<Void>> append(List<byte[]> serialized) {
        serialized.forEach(bytes -> note(JournalRecordCodec.read(bytes)));
        return Optional.of(CompletableFuture.completedFuture(null));
    }

    private void note(KafkaRecord record) {
        if (record.bytes() > SETTINGS.maxRecordBytes()) {
            throw new IllegalStateException("a record of " + record.bytes() + " bytes");
        }
        if (record.topic().equals(SETTINGS.deadLetterTopic())) {
            told.add(new String(record.value(), UTF_8));
        } else if (record.value() == null) {
            deleted.put(record.key(), record.headers().getOrDefault(HeaderNames.ENTITY_TYPE, ""));
        } else {
            try {
                Entity.parse(record.value());
            } catch (UnreadableException e) {
                throw new IllegalStateException("a record that no reader can read", e);
            }
            told.add(record.key());
        }
    }
}
