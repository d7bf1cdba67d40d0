package io.furrow.connect.source;

import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.ledger.Ledger;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;

/**
 * Makes dead letters of records that are larger than their topic takes: the producer's failure at one of them would stop the task,
 * and stop it again after each restart. A dead letter that is too large itself is cut.
 */
final class RecordSizes {
    private static final int ROOM_FOR_SENTENCE = 100;

    private final TopicLimits limits;
    private final int maxRecordBytes;
    private final String deadLetterTopic;
    private final Ledger ledger;

    /** @param maxRecordBytes what the producer takes */
    RecordSizes(TopicLimits limits, int maxRecordBytes, String deadLetterTopic, Ledger ledger) {
        this.limits = limits;
        this.maxRecordBytes = maxRecordBytes;
        this.deadLetterTopic = deadLetterTopic;
        this.ledger = ledger;
    }

    /** What goes to Kafka for a record of the journal. */
    OutgoingRecord fitting(JournalRecord kept) {
        OutgoingRecord record = RecordForm.read(kept.payload());
        long limit = limit(record.topic());
        // The journal's form is about as long, and measured already.
        if (kept.payload().length + SizeOptions.ROOM_FOR_TRANSFORMATIONS <= limit || record.bytes() <= limit) {
            return record;
        }
        if (record.topic().equals(deadLetterTopic)) {
            return letter(record, new LinkedHashMap<>(record.headers()));
        }
        ledger.oversized.increment();
        String message = "the record of %s has %d bytes, topic %s takes %d; raise its max.message.bytes, and %s"
                .formatted(record.key(), record.bytes(), record.topic(), limit, SizeOptions.PRODUCER_LIMIT);
        Map<String, String> headers = new LinkedHashMap<>(record.headers());
        headers.putAll(
                new DeadLetter(Reason.TOO_LARGE, message, NotificationTranslator.STAGE, record.topic()).headers());
        return letter(record, headers);
    }

    private long limit(String topic) {
        long ofTopic = limits.of(topic);
        return Math.min(
                maxRecordBytes,
                ofTopic == TopicLimits.UNKNOWN ? ofTopic : ofTopic - SizeOptions.ROOM_FOR_TRANSFORMATIONS);
    }

    /** With as much of the value as the topic of dead letters takes. */
    private OutgoingRecord letter(OutgoingRecord record, Map<String, String> headers) {
        byte[] value = record.value();
        OutgoingRecord letter = new OutgoingRecord(deadLetterTopic, record.key(), value, record.time(), headers);
        long excess = letter.bytes() - limit(deadLetterTopic);
        if (excess <= 0 || value == null) {
            return letter;
        }
        int room = (int) Math.max(0, value.length - excess - ROOM_FOR_SENTENCE);
        headers.computeIfPresent(DeadLetter.MESSAGE, (name, message) -> message + " (truncated to " + room + " bytes)");
        return new OutgoingRecord(deadLetterTopic, record.key(), Arrays.copyOf(value, room), record.time(), headers);
    }
}
