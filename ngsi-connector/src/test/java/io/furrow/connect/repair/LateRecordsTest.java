package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.repair.LateRecords.Late;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static org.assertj.core.api.Assertions.assertThat;

class LateRecordsTest {
    private static final Instant T = Instant.parse("2026-11-21T12:00:00Z");

    @TempDir
    private Path folder;

    private LateRecords records;

    @BeforeEach
    void open() throws IOException {
        records = LateRecords.open(folder.resolve("late"));
    }

    @Test
    void keepsTheOldestAcrossARestart() throws IOException {
        records.add(T);
        records.add(T.minusMillis(1));
        records.add(T.plusMillis(1));

        assertThat(records.late()).map(Late::from).contains(T.minusMillis(1));
        open();
        assertThat(records.late()).map(Late::from).contains(T.minusMillis(1));
    }

    @Test
    void forgetsThoseThatWereReadAgainUnlessOthersCame() throws IOException {
        records.add(T);
        var before = records.late();
        records.add(T.plusMillis(1));

        records.settle(before);
        assertThat(records.late()).isPresent();

        records.settle(records.late());
        assertThat(records.late()).isEmpty();
        open();
        assertThat(records.late()).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"yesterday", "", "\u00ff\u0000"})
    void readsAllAgainWhereItsFileIsUnreadable(String damaged) throws IOException {
        Files.write(folder.resolve("late"), damaged.getBytes(ISO_8859_1));

        open();

        assertThat(records.late()).map(Late::from).contains(Instant.EPOCH);
    }
}
