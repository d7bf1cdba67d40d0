package io.furrow.connect.source;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import org.apache.kafka.connect.data.SchemaAndValue;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.header.ConnectHeaders;
import org.apache.kafka.connect.source.SourceRecord;

import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.journal.TaskJournals;
import io.furrow.connect.source.option.KeyMode;
import io.furrow.connect.source.option.ValueMode;

/** Converts journal records into records for the worker. */
record SourceRecords(KeyMode keys, ValueMode values) {
    /**
     * @param reading the record that is sent to Kafka for a journal record
     * @throws ConnectException if a newer version of the plugin wrote one of them
     */
    List<SourceRecord> of(TaskJournals.Batch turn, Function<JournalRecord, KafkaRecord> reading) {
        Map<String, String> partition = SourceOffsets.partition(turn.journal());
        List<SourceRecord> records = new ArrayList<>(turn.records().size());
        for (JournalRecord kept : turn.records()) {
            try {
                records.add(of(partition, kept.sequence(), reading.apply(kept)));
            } catch (IllegalArgumentException e) {
                throw new ConnectException(
                        "journal " + turn.journal() + ", record " + kept.sequence() + ": " + e.getMessage()
                                + "; it was written by another version of the plugin, which must produce it first",
                        e);
            }
        }
        return records;
    }

    private SourceRecord of(Map<String, String> partition, long sequence, KafkaRecord record) {
        ConnectHeaders headers = new ConnectHeaders();
        record.headers().forEach(headers::addString);
        SchemaAndValue key = keys.of(record.key());
        SchemaAndValue value = values.of(record, headers);
        return new SourceRecord(
                partition,
                SourceOffsets.offsetOf(sequence),
                record.topic(),
                null,
                key.schema(),
                key.value(),
                value.schema(),
                value.value(),
                record.time().toEpochMilli(),
                headers);
    }
}
