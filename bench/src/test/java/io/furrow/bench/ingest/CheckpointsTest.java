package io.furrow.bench.ingest;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class CheckpointsTest {
    @TempDir
    private Path folder;

    @Test
    void hasTheBytesOfTheNewestThatIsComplete() throws IOException {
        checkpoint(9, "_metadata", 10);
        checkpoint(9, "state", 500);
        checkpoint(10, "_metadata", 20);
        checkpoint(10, "state", 3_000);
        checkpoint(11, "state", 70);

        assertThat(Checkpoints.bytesAfter(folder, 8)).hasValue(3_020);
        assertThat(Checkpoints.bytesAfter(folder, 10)).isEmpty();
        checkpoint(11, "_metadata", 5);
        assertThat(Checkpoints.bytesAfter(folder, 10)).hasValue(75);
    }

    private void checkpoint(int number, String file, int bytes) throws IOException {
        Path checkpoint = Files.createDirectories(folder.resolve("0123").resolve("chk-" + number));
        Files.write(checkpoint.resolve(file), new byte[bytes]);
    }
}
