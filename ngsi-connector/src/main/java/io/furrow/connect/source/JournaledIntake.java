package io.furrow.connect.source;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalException;
import io.furrow.connect.ledger.Ledger;

/** Takes records into a journal; they are durable when the disk has them. */
final class JournaledIntake implements Intake {
    private final Journal journal;
    private final Ledger ledger;

    JournaledIntake(Journal journal, Ledger ledger) {
        this.journal = journal;
        this.ledger = ledger;
    }

    @Override
    public Optional<CompletableFuture<Void>> take(List<OutgoingRecord> records) {
        return append(records.stream().map(RecordForm::write).toList());
    }

    /** Takes records that are serialized, all or none; quick. */
    Optional<CompletableFuture<Void>> append(List<byte[]> records) {
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

    /** A folder that lives as long as the records do, for small files beside them. */
    Path folder() {
        return journal.folder();
    }
}
