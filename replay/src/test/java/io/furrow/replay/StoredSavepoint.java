package io.furrow.replay;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.apache.flink.api.common.JobID;

import io.furrow.files.Folders;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;

import static org.awaitility.Awaitility.await;

/** Stores a savepoint of what the job is now, for every later build to restore: a paused replay, of which some events were played. */
final class StoredSavepoint {
    /** A folder per release, below that of the module. */
    static final Path FOLDER = Path.of("src/test/resources/savepoints");

    static final String MISSION = "stored";
    static final int EVENTS = 100;
    static final int PLAYED = 10;

    private StoredSavepoint() {}

    /** @param target names the release; one that is stored is never written again */
    static void store(ReplaySuite suite, Path target, Path work) throws Exception {
        if (Files.exists(target)) {
            throw new IllegalStateException(target + " is there already and stays as it is; name another release");
        }
        suite.store(MISSION, EVENTS, 1_000);
        suite.want(paused());
        JobID job = suite.run(null, "--parallelism", "1");
        await().until(() -> {
            ReplayStatus status = suite.status(MISSION);
            return status != null
                    && status.progress() != null
                    && status.progress().events() == PLAYED;
        });
        Path written = ReplaySuite.path(suite.stop(job, work));
        requireOneFile(written);
        Files.createDirectories(target);
        Files.copy(written.resolve("_metadata"), target.resolve("_metadata"));
    }

    private static void requireOneFile(Path savepoint) throws IOException {
        if (Folders.list(savepoint).size() != 1) {
            throw new IllegalStateException("the savepoint should be small enough to be one file: " + savepoint);
        }
    }

    /** With a step to each of the events that are played. */
    static DesiredReplay paused() {
        return ReplaySuite.desired(MISSION, 1, State.PAUSED, 1).stepping(PLAYED, 1);
    }
}
