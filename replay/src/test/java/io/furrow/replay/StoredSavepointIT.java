package io.furrow.replay;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.IntStream;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.EnabledIfSystemProperty;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.files.Folders;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Restores the savepoints that {@link StoredSavepoint} has written for each release. */
@Timeout(180)
@Tag("full")
class StoredSavepointIT {
    @TempDir
    Path directory;

    @AutoClose
    private ReplaySuite suite;

    @BeforeEach
    void start() throws Exception {
        suite = ReplaySuite.start(directory.resolve("suite"));
    }

    /** Writes the savepoint of a release with {@code -Dstore.savepoint=0.2.0}. */
    @Test
    @EnabledIfSystemProperty(named = "store.savepoint", matches = "[0-9.]+")
    void isWrittenOncePerRelease() throws Exception {
        Path target = StoredSavepoint.FOLDER.resolve(System.getProperty("store.savepoint"));

        StoredSavepoint.store(suite, target, directory);

        assertThat(target.resolve("_metadata")).isNotEmptyFile();
    }

    @ParameterizedTest
    @MethodSource("releases")
    void continuesWithTheNextEvent(Path savepoint) throws Exception {
        suite.store(StoredSavepoint.MISSION, StoredSavepoint.EVENTS, 1_000);
        suite.publish(StoredSavepoint.paused());
        suite.publish(ReplaySuite.desired(StoredSavepoint.MISSION, ReplayCommand.MAX, State.RUNNING, 2));

        suite.run(savepoint.toUri().toString(), "--parallelism", "1");
        await().until(() -> {
            ReplayStatus status = suite.status(StoredSavepoint.MISSION);
            return status != null && status.state() == State.ENDED;
        });

        List<Integer> numbers = suite.records(Topics.replay(StoredSavepoint.MISSION, "0a1b2c3d")).stream()
                .filter(record ->
                        ReplaySuite.header(record, HeaderNames.REPLAY_KIND).equals("event"))
                .map(record -> Integer.valueOf(ReplaySuite.header(record, HeaderNames.REPLAY_SEQUENCE)))
                .sorted()
                .toList();
        assertThat(numbers)
                .isEqualTo(IntStream.range(StoredSavepoint.PLAYED, StoredSavepoint.EVENTS)
                        .boxed()
                        .toList());
    }

    private static List<Path> releases() throws IOException {
        return Folders.list(StoredSavepoint.FOLDER);
    }
}
