package io.furrow.connect.source;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.header.ConnectHeaders;
import org.apache.kafka.connect.source.SourceRecord;

import io.furrow.connect.journal.JournalRecord;

/** Journal records as the worker wants them. */
final class SourceRecords {
    private SourceRecords() {}

    /** @throws ConnectException if a newer version of the plugin wrote one of them */
    static List<SourceRecord> of(TaskJournals.Turn turn, RecordSizes sizes) {
        Map<String, String> partition = SourceOffsets.partition(turn.journal());
        List<SourceRecord> records = new ArrayList<>(turn.records().size());
        for (JournalRecord kept : turn.records()) {
            try {
                records.add(of(partition, kept.sequence(), sizes.fitting(kept)));
            } catch (IllegalArgumentException e) {
                throw new ConnectException(
                        "journal " + turn.journal() + ", record " + kept.sequence() + ": " + e.getMessage()
                                + "; it was written by another version of the plugin, which must produce it first",
                        e);
            }
        }
        return records;
    }

    private static SourceRecord of(Map<String, String> partition, long sequence, OutgoingRecord record) {
        ConnectHeaders headers = new ConnectHeaders();
        record.headers().forEach(headers::addString);
        return new SourceRecord(
                partition,
                SourceOffsets.offsetOf(sequence),
                record.topic(),
                null,
                record.key() == null ? null : Schema.STRING_SCHEMA,
                record.key(),
                record.value() == null ? Schema.OPTIONAL_BYTES_SCHEMA : Schema.BYTES_SCHEMA,
                record.value(),
                record.time().toEpochMilli(),
                headers);
    }
}
