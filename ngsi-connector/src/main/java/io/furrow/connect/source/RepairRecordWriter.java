package io.furrow.connect.source;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.repair.MissedChange;
import io.furrow.connect.repair.RepairOutput;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.source.journal.JournalRecordLog;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.LogText;

/** Creates records from the findings of the repair and appends them to the intake. */
record RepairRecordWriter(NotificationTranslator.Settings settings, JournalRecordLog recordLog, Ledger ledger)
        implements RepairOutput {

    @Override
    public byte[] serialize(String subscription, MissedChange finding) {
        return JournalRecordCodec.write(record("/ngsi/" + subscription, finding));
    }

    @Override
    public Optional<CompletableFuture<Void>> append(List<byte[]> records) {
        return recordLog.append(records).map(durable -> durable.thenRun(() -> ledger.repaired.add(records.size())));
    }

    private KafkaRecord record(String source, MissedChange finding) {
        if (finding instanceof MissedChange.Deleted deleted) {
            EntityDeletion gone = deleted.deletion();
            return new KafkaRecord(settings.topic(), gone.entityId(), null, gone.time(), gone.headers(source));
        }
        if (finding instanceof MissedChange.Unreadable unreadable) {
            String id = unreadable.entityId();
            UnreadableException problem = unreadable.problem();
            String message = "the entity %s of the context broker cannot be read: %s"
                    .formatted(id.isEmpty() ? "without an id" : LogText.beginning(id), problem.getMessage());
            DeadLetter letter = new DeadLetter(problem.reason(), message, NotificationTranslator.STAGE, source);
            return deadLetter(letter, id, unreadable.received());
        }
        EntityEvent event = ((MissedChange.Changed) finding).event();
        KafkaRecord record = new KafkaRecord(
                settings.topic(),
                event.entity().id(),
                event.entity().toBytes(),
                event.time().time(),
                event.headers(source));
        return record.bytes() <= settings.maxRecordBytes() ? record : deadLetter(record, event, source);
    }

    /** The entity is still in the context broker, so its id is enough to find it. */
    private KafkaRecord deadLetter(KafkaRecord record, EntityEvent event, String source) {
        String message = "the record of the entity " + event.entity().id() + " has " + record.bytes()
                + " bytes, the limit is " + settings.maxRecordBytes();
        DeadLetter letter = new DeadLetter(Reason.TOO_LARGE, message, NotificationTranslator.STAGE, source);
        return deadLetter(letter, event.entity().id(), event.received());
    }

    private KafkaRecord deadLetter(DeadLetter letter, String id, Instant received) {
        byte[] value = id.getBytes(StandardCharsets.UTF_8);
        return new KafkaRecord(settings.deadLetterTopic(), null, value, received, letter.headers());
    }
}
