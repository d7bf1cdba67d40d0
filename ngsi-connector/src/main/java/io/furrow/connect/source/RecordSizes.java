package io.furrow.connect.source;

import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.connect.source.option.SizeOptions;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;

/**
 * Converts records that are larger than their topic accepts into dead letters: the producer's failure would stop the
 * task, and stop it again after each restart. A dead letter that is itself too large is truncated.
 *
 * @param maxRecordBytes the producer's limit
 */
record RecordSizes(TopicLimits limits, int maxRecordBytes, String deadLetterTopic, Ledger ledger) {
    private static final int ROOM_FOR_SENTENCE = 100;

    /** The record that is sent to Kafka for a journal record. */
    KafkaRecord fitting(JournalRecord kept) {
        KafkaRecord record = JournalRecordCodec.read(kept.payload());
        long limit = limit(record.topic());
        // The journal's format has about the same length and is already measured.
        if (kept.payload().length + SizeOptions.ROOM_FOR_TRANSFORMATIONS <= limit || record.bytes() <= limit) {
            return record;
        }
        if (record.topic().equals(deadLetterTopic)) {
            return letter(record, new LinkedHashMap<>(record.headers()));
        }
        ledger.oversized.increment();
        String message = "the record of %s has %d bytes, topic %s accepts %d; raise its max.message.bytes, and %s"
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

    /** A dead letter with as much of the value as the dead-letter topic accepts. */
    private KafkaRecord letter(KafkaRecord record, Map<String, String> headers) {
        byte[] value = record.value();
        KafkaRecord letter = new KafkaRecord(deadLetterTopic, record.key(), value, record.time(), headers);
        long excess = letter.bytes() - limit(deadLetterTopic);
        if (excess <= 0 || value == null) {
            return letter;
        }
        int room = (int) Math.max(0, value.length - excess - ROOM_FOR_SENTENCE);
        headers.computeIfPresent(DeadLetter.MESSAGE, (name, message) -> message + " (truncated to " + room + " bytes)");
        return new KafkaRecord(deadLetterTopic, record.key(), Arrays.copyOf(value, room), record.time(), headers);
    }
}
