package io.furrow.replay;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.UnmatchedArgumentException;

import io.furrow.flink.JobUids;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.replay.source.DesiredReplays;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ReplayUidsTest {
    private static ReplayOptions options(String... args) {
        ReplayOptions options = new ReplayOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }

    @Test
    void keepsTheUidsOfSavepoints() {
        assertThat(JobUids.of(ReplayJob.assemble(options("--mongo", "mongodb://127.0.0.1:27017"))))
                .isEqualTo(JobUids.checkedIn("replay"));
    }

    @Test
    void playsOneMissionOnce() {
        ReplayOptions once = options("--mongo", "mongodb://h", "--once", "--mission", "m", "--speed", "max");

        assertThat(once.desired().isBounded()).isTrue();
        assertThat(JobUids.of(ReplayJob.assemble(once))).doesNotContain("write-statuses");
    }

    @Test
    void boundsTheMissionByFromAndTo() {
        DesiredReplays once = options(
                        "--mongo mongodb://h --once --mission m --from 1970-01-01T00:00:01Z --to 1970-01-01T00:00:02Z"
                                .split(" "))
                .desired();

        assertThat(new String(((DesiredReplays.One) once).desired(), UTF_8)).contains("\"from\":1000", "\"to\":2000");
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "--input", "--out-of-orderness", "--idle-timeout",
                "--idle-advance", "--clock-skew", "--max-ahead",
                "--max-behind"
            })
    void hasNoOptionsWithoutEffect(String option) {
        assertThatThrownBy(() -> options("--mongo", "mongodb://h", option))
                .isInstanceOf(UnmatchedArgumentException.class);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", textBlock = """
            --once                                   | --once has no mission
            --once --mission m.n                     | --mission m.n is not a name
            --once --mission m --speed 2000          | --speed 2000 is neither
            --once --mission m --from yesterday      | --from yesterday is not a time
            --once --mission m --to tomorrow         | --to tomorrow is not a time
            --once --mission m --topic data.raw      | --topic data.raw is not a topic of a replay
            --once --mission m --source-topic data.t --source-file f | are both given
            """)
    void rejectsInvalidOptions(String args, String reason) {
        ReplayOptions options = options(("--mongo mongodb://h " + args).split(" +"));

        assertThatThrownBy(options::desired)
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining(reason);
    }
}
