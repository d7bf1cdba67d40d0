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

/** Stores a savepoint of the current job, a paused replay with some events played, for later builds to restore. */
final class StoredSavepoint {
    /** Contains one folder per release; relative to the module. */
    static final Path FOLDER = Path.of("src/test/resources/savepoints");

    static final String MISSION = "stored";
    static final int EVENTS = 100;
    static final int PLAYED = 10;

    private StoredSavepoint() {}

    /** @param target folder of the release; an existing one is never overwritten */
    static void store(ReplaySuite suite, Path target, Path work) throws Exception {
        if (Files.exists(target)) {
            throw new IllegalStateException(target + " exists already and is not overwritten; name another release");
        }
        suite.store(MISSION, EVENTS, 1_000);
        suite.publish(paused());
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

    /** Returns a paused replay with a step to each played event. */
    static DesiredReplay paused() {
        return ReplaySuite.desired(MISSION, 1, State.PAUSED, 1).stepping(PLAYED, 1);
    }
}
