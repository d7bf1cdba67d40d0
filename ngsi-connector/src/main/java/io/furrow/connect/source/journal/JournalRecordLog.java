package io.furrow.connect.source.journal;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalException;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;

/** Appends records to a journal; they are durable once they are on disk. */
public record JournalRecordLog(Journal journal, Ledger ledger) implements RecordLog {

    @Override
    public Optional<CompletableFuture<Void>> take(List<KafkaRecord> records) {
        return append(records.stream().map(JournalRecordCodec::write).toList());
    }

    /** Appends serialized records, all or none; does not block. */
    public Optional<CompletableFuture<Void>> append(List<byte[]> records) {
        return journal.append(records)
                .map(durable -> durable.handle((nothing, failure) -> {
                    if (failure instanceof JournalException.NoRoom) {
                        throw new NoRoomException();
                    }
                    if (failure != null) {
                        throw new ClosedException(failure);
                    }
                    ledger.durable.add(records.size());
                    return null;
                }));
    }
}
