package io.furrow.launcher.suite;

import java.nio.file.Files;
import java.nio.file.Path;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.cli.option.CommandException;
import io.furrow.embedded.EmbeddedFlink;

import static org.assertj.core.api.Assertions.assertThatThrownBy;

class JobsIT {
    @Test
    void reportsWhichJobCannotContinueFromItsState(@TempDir Path directory) throws Exception {
        Path state = Files.createDirectories(directory.resolve("ingest/0a1b/chk-3"));
        Files.writeString(state.resolve("_metadata"), "damaged");
        StreamExecutionEnvironment env = StreamExecutionEnvironment.createLocalEnvironment();
        env.fromSequence(1, 2).sinkTo(new DiscardingSink<>());
        try (EmbeddedFlink flink = EmbeddedFlink.start(4, 0)) {
            Jobs jobs = new Jobs(flink, directory);
            jobs.submit("ingest", env);

            assertThatThrownBy(jobs::awaitStarted)
                    .isInstanceOf(CommandException.class)
                    .hasMessageStartingWith(
                            "Job ingest cannot continue from its state in " + directory.resolve("ingest"));
        }
    }
}
