package io.furrow.connect.source.journal;

import java.nio.file.Path;
import java.util.OptionalLong;
import java.util.concurrent.atomic.AtomicInteger;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.journal.JournalSettings;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.source.SourceOnConnect;

class JournalMaintenanceTest {
    @Test
    void asksOnAfterAnyError(@TempDir Path directory) {
        AtomicInteger asked = new AtomicInteger();
        TaskJournals.Committed committed = journal -> {
            if (asked.incrementAndGet() == 2) {
                throw new LinkageError("thrown by a test");
            }
            return OptionalLong.empty();
        };
        JournalSettings settings = JournalSettings.of(64 * 1024 * 1024, 1024 * 1024, 0);
        JournalFolders folders = new JournalFolders(directory, "asked", settings);
        try (TaskJournals journals = new TaskJournals(folders, 0, committed, TaskJournals.Safety.NONE, new Ledger());
                JournalMaintenance maintenance = JournalMaintenance.start(journals, true)) {
            SourceOnConnect.await().until(() -> asked.get() > 3 && !maintenance.isKafkaUnavailable());
        }
    }
}
