package io.furrow.ingest.mission;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.ParameterException;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionOptionsTest {
    @Test
    void keepMissionsOnlyWhereAMongoIsNamed() {
        assertThat(parsed().isOn()).isFalse();
        assertThat(parsed("--mongo", "mongodb://127.0.0.1").isOn()).isTrue();
    }

    @Test
    void tryARefusalOfUnknownReasonForLong() {
        assertThat(parsed("--mongo", "mongodb://127.0.0.1").access().waits())
                .isEqualTo(new MongoAccess.Waits(Duration.ofMinutes(1), Duration.ofMinutes(5)));
        assertThat(parsed("--mongo", "mongodb://127.0.0.1", "--mongo-refusal-timeout", "9min")
                        .access()
                        .waits()
                        .unknown())
                .isEqualTo(Duration.ofMinutes(9));
    }

    @Test
    void keepDocumentsForEverUnlessTold() {
        assertThat(parsed().retention()).isEqualTo(Retention.FOR_EVER);
        assertThat(parsed().retention().of("mission_weeding")).isEmpty();
    }

    @Test
    void keepDocumentsOfAMissionAsLongAsThatMissionShall() {
        Retention retention = parsed("--mission-retention", "30d", "--mission-retention", "field.7=12h")
                .retention();

        assertThat(retention.of("mission__x-field-2E7")).contains(Duration.ofHours(12));
        assertThat(retention.of("mission_weeding")).contains(Duration.ofDays(30));
        assertThat(retention.shortest()).contains(Duration.ofHours(12));
    }

    @ParameterizedTest
    @ValueSource(strings = {"long", "5ms", "weeding=", "99999d"})
    void refuseARetentionThatIsNone(String retention) {
        assertThatThrownBy(() -> parsed("--mission-retention", retention).retention())
                .isInstanceOf(ParameterException.class)
                .hasMessageContainingAll("--mission-retention", "write for instance");
    }

    @ParameterizedTest
    @ValueSource(strings = {"localhost:27017", "http://localhost", "mongodb://"})
    void refuseAnAddressThatIsNone(String uri) {
        assertThatThrownBy(() -> parsed("--mongo", uri).access())
                .isInstanceOf(ParameterException.class)
                .hasMessageContainingAll("--mongo", "mongodb://127.0.0.1:27017");
    }

    @Test
    void readTheAddressFromAFileSoThatNoPasswordIsOnTheCommandLine(@TempDir Path directory) throws IOException {
        Path file = Files.writeString(
                directory.resolve("mongo-uri"), "mongodb://furrow:p%23w@mongo:27017/?authSource=admin\n");

        assertThat(parsed("--mongo", "@" + file).access().uri())
                .isEqualTo("mongodb://furrow:p%23w@mongo:27017/?authSource=admin");
    }

    @Test
    void nameTheFileThatCannotBeRead(@TempDir Path directory) {
        Path missing = directory.resolve("missing");

        assertThatThrownBy(() -> parsed("--mongo", "@" + missing).access())
                .isInstanceOf(ParameterException.class)
                .hasMessageContainingAll("--mongo", missing + " cannot be read");
    }

    private static MissionOptions parsed(String... args) {
        Job job = new Job();
        CommandLine line = JobCommandLine.of(job);
        line.parseArgs(args);
        return job.missions;
    }

    @Command(name = "job")
    private static final class Job {
        @Mixin
        private final MissionOptions missions = new MissionOptions();
    }
}
