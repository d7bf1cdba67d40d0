package io.furrow.launcher.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class LatestCheckpointTest {
    @TempDir
    Path job;

    @Test
    void findsNoneWhereTheJobNeverRan() {
        assertThat(LatestCheckpoint.below(job.resolve("never"))).isEmpty();
        assertThat(LatestCheckpoint.below(job)).isEmpty();
    }

    @Test
    void takesTheNewestThatIsCompleteBeItCheckpointOrSavepoint() throws IOException {
        complete("0a1b/chk-3", 1_000);
        Path savepoint = complete("savepoint-77", 3_000);
        complete("ffff/chk-9", 2_000);
        Files.createDirectories(job.resolve("ffff/chk-10")); // the job died while it wrote this one

        assertThat(LatestCheckpoint.below(job)).contains(savepoint);
    }

    private Path complete(String name, long millis) throws IOException {
        Path state = Files.createDirectories(job.resolve(name));
        Files.setLastModifiedTime(Files.createFile(state.resolve("_metadata")), FileTime.fromMillis(millis));
        return state;
    }
}
