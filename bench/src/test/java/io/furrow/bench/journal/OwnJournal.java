package io.furrow.bench.journal;

import java.nio.file.Path;
import java.util.List;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalSettings;

/** The source's own journal, as it is used. */
final class OwnJournal implements JournalComparison.Candidate {
    private static final long GIB = 1L << 30;

    private final Journal journal;

    OwnJournal(Path folder) {
        journal =
                Journal.open(folder, JournalSettings.of(16 * GIB, GIB / 16, 0)).orElseThrow();
    }

    @Override
    public void append(byte[] record) {
        journal.append(List.of(record)).orElseThrow().join();
    }

    @Override
    public void close() {
        journal.close();
    }
}
