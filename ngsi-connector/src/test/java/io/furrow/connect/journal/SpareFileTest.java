package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class SpareFileTest {
    private static final int BYTES = 3 * 1024 * 1024 + 7;

    @TempDir
    private Path folder;

    private final SpareFile spare = new SpareFile();
    private Path file;

    @BeforeEach
    void name() {
        file = folder.resolve("spare");
    }

    @Test
    void isThereInFullSizeWhenItIsNeeded() throws IOException {
        spare.make(file, BYTES);

        assertThat(spare.take(BYTES)).contains(file);

        assertThat(Files.readAllBytes(file)).isEqualTo(new byte[BYTES]);
        assertThat(spare.take(BYTES)).isEmpty();
    }

    @Test
    void replacesWhatHasItsName() throws IOException {
        Files.write(file, new byte[] {1, 2, 3});
        spare.make(file, 2);

        assertThat(spare.take(2)).contains(file);

        assertThat(file).hasBinaryContent(new byte[2]);
    }

    @Test
    void isNotGivenForAnotherSize() {
        spare.make(file, BYTES);

        assertThat(spare.take(BYTES + 1)).isEmpty();
        assertThat(spare.take(BYTES)).contains(file);
    }

    @Test
    void isNotGivenIfItCouldNotBeMade() {
        spare.make(folder.resolve("missing").resolve("spare"), BYTES);

        assertThat(spare.take(BYTES)).isEmpty();
    }

    @Test
    void isMadeAnewAfterAnError() {
        spare.make(file, -1);

        assertThat(spare.take(-1)).isEmpty();
        spare.make(file, BYTES);
        assertThat(spare.take(BYTES)).contains(file);
    }

    @Test
    void isDeletedWhenNobodyWantsIt() {
        spare.make(file, BYTES);

        spare.discard();

        assertThat(file).doesNotExist();
        assertThat(spare.take(BYTES)).isEmpty();
    }
}
