package io.furrow.flink.job;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.client.program.ProgramParametrizationException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine.ParameterException;

import io.furrow.flink.kafka.TopicOptions;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class JobOptionsTest {
    private static final int REFUSED = 2;

    @Test
    void haveTheDefaultsOfTheManual() {
        JobOptions options = parsed("copy");

        assertThat(options.jobName()).isEqualTo("copy");
        assertThat(options.bootstrapServers()).isEqualTo("127.0.0.1:9092");
        assertThat(options.input()).containsExactly("data.raw");
        assertThat(options.delivery()).isEqualTo(Delivery.AT_LEAST_ONCE);
        assertThat(options.outOfOrderness()).isEqualTo(Duration.ofSeconds(2));
        assertThat(options.idleTimeout()).isEqualTo(Duration.ofSeconds(10));
        assertThat(options.checkpointInterval()).isEmpty();
        assertThat(options.from().kind()).isEqualTo(StartPosition.Kind.COMMITTED);
        assertThat(options.checkpointDir()).isEmpty();
        assertThat(options.parallelism()).isEmpty();
        assertThat(options.kafkaProperties()).isEmpty();
    }

    @Test
    void takeWhatTheCommandLineSays(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve("kafka.properties"), "security.protocol=SSL\n");

        JobOptions options = parsed(
                ("copy --name north.copy --from 2026-05-01T06:00:00Z --kafka a:1,b:2 --input x,y --delivery Exactly-Once --out-of-orderness 0s"
                                + " --idle-timeout 1min --checkpoint-interval 500ms --checkpoint-dir file:///c"
                                + " --parallelism 3 --kafka-properties " + file)
                        .split(" "));

        assertThat(options.jobName()).isEqualTo("north.copy");
        assertThat(options.groupId()).isEqualTo("furrow-north.copy");
        assertThat(options.from().time()).contains(Instant.parse("2026-05-01T06:00:00Z"));
        assertThat(options.bootstrapServers()).isEqualTo("a:1,b:2");
        assertThat(options.input()).containsExactly("x", "y");
        assertThat(options.delivery()).isEqualTo(Delivery.EXACTLY_ONCE);
        assertThat(options.outOfOrderness()).isZero();
        assertThat(options.idleTimeout()).isEqualTo(Duration.ofMinutes(1));
        assertThat(options.checkpointInterval()).contains(Duration.ofMillis(500));
        assertThat(options.checkpointDir()).contains("file:///c");
        assertThat(options.parallelism()).contains(3);
        assertThat(options.kafkaProperties()).containsEntry("security.protocol", "SSL");
        assertThat(options.effective())
                .containsEntry("--kafka", "a:1,b:2")
                .containsEntry("--parallelism", "3")
                .doesNotContainKey("--help");
    }

    @Test
    void giveEachReplayAnInstance() {
        JobOptions first = parsed("copy", "--input", "data.hoeing.replay.0a1b2c3d");
        JobOptions second = parsed("copy", "--input", "data.hoeing.replay.11111111");

        assertThat(first.jobName()).isEqualTo("copy-hoeing.0a1b2c3d");
        assertThat(first.groupId()).isEqualTo("furrow-copy-hoeing.0a1b2c3d").isNotEqualTo(second.groupId());
        assertThat(parsed("copy", "--name", "mine", "--input", "data.hoeing.replay.0a1b2c3d")
                        .jobName())
                .isEqualTo("mine");
    }

    @Test
    void refuseAReplayBesideWhatHasAnotherEventTime() {
        var mixed = TestJob.run(JobOptions::inputTopics, "copy", "--input", "data.raw,data.hoeing.replay.0a1b2c3d");
        TestJob.Outcome advanced = TestJob.run(
                JobOptions::idleAdvance, "copy", "--input", "data.hoeing.replay.0a1b2c3d", "--idle-advance");

        assertThat(mixed.exitCode()).isEqualTo(REFUSED);
        assertThat(mixed.err())
                .startsWith(
                        "--input data.raw,data.hoeing.replay.0a1b2c3d: a replay shares its event time with no other topic;"
                                + " start an instance for it alone, 'copy --input data.hoeing.replay.0a1b2c3d', and one for the others");
        assertThat(advanced.exitCode()).isEqualTo(REFUSED);
        assertThat(advanced.err())
                .startsWith("--idle-advance goes by the wall clock, and a replay does not; leave it out");
    }

    @Test
    void showTheValuesInForceAsOneWouldWriteThem() {
        JobOptions options = parsed("copy", "--input", "x,y", "--idle-timeout", "1min");

        assertThat(options.effective())
                .containsEntry("--input", "x,y")
                .containsEntry("--idle-timeout", "1min")
                .containsEntry("--out-of-orderness", "2s")
                .containsEntry("--delivery", "at-least-once")
                .doesNotContainKey("--parallelism");
    }

    @Test
    void showNoPasswordOfAnAddress() {
        JobOptions options = parsed("copy", "--checkpoint-dir", "s3://key:secret@store/checkpoints");

        assertThat(options.effective()).containsEntry("--checkpoint-dir", "s3://***@store/checkpoints");
    }

    @Test
    void explainThemselves() {
        TestJob.Outcome outcome = TestJob.run(options -> {}, "copy", "--help");

        assertThat(outcome.exitCode()).isZero();
        assertThat(outcome.err()).isEmpty();
        assertThat(outcome.out().replaceAll("\\s+", " "))
                .contains("--kafka, --bootstrap-servers=HOST:PORT,…", "Default: 127.0.0.1:9092.")
                .contains("--input=TOPIC,…", "Default: data.raw.")
                .contains("--delivery=MODE", "exactly-once: visible after each checkpoint", "Default: at-least-once.")
                .contains("--out-of-orderness=DURATION", "Default: 2s.")
                .contains("--idle-timeout=DURATION", "Default: 10s.")
                .contains("--checkpoint-interval=DURATION", "--checkpoint-dir=URI", "--parallelism=N")
                .contains("--kafka-properties=FILE", "-h, --help")
                .doesNotContain("${");
    }

    @Test
    void refuseAPropertiesFileThatCannotBeRead(@TempDir Path directory) throws Exception {
        Path missing = directory.resolve("missing.properties");
        Path latin1 = Files.write(directory.resolve("latin1"), "a=ñ".getBytes(ISO_8859_1));
        Path broken = Files.writeString(directory.resolve("broken"), "a=\\u12G4\n");

        for (Path file : List.of(missing, directory, latin1, broken)) {
            var outcome = TestJob.run(JobOptions::kafkaProperties, "copy", "--kafka-properties", file.toString());

            assertThat(outcome.exitCode()).isEqualTo(REFUSED);
            assertThat(outcome.err().lines())
                    .containsExactly(
                            "--kafka-properties " + file + " cannot be read; name a readable properties file",
                            "See: jobs copy --help");
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            --delivery twice             | 'twice' is not a delivery; write at-least-once or exactly-once
            --idle-timeout 10            | '10' is not a duration; write for instance
            --checkpoint-interval 9ms    | --checkpoint-interval is below 10ms; write for instance 1s
            --name a/b                   | --name 'a/b' is not 1 to 100 of A-Z a-z 0-9 . _ -
            --from yesterday             | 'yesterday' is not a position; write committed, earliest, latest or a time as in
            --from 1969-01-01T00:00:00Z  | '1969-01-01T00:00:00Z' is before 1970, where no record can be
            --parallelism 0              | --parallelism 0 is not between 1 and 720
            --parallelism 721            | --parallelism 721 is not between 1 and 720
            --parallelism many           | --parallelism
            --no-such-option 1           | --no-such-option
            """)
    void refuseAWrongSettingInOneSentence(String arguments, String sentence) {
        TestJob.Outcome outcome =
                TestJob.run(options -> JobEnvironment.create(options), ("copy " + arguments).split(" "));

        assertThat(outcome.exitCode()).isEqualTo(REFUSED);
        assertThat(outcome.err().lines()).hasSize(2).first().asString().contains(sentence);
        assertThat(outcome.err()).contains("See: jobs copy --help");
    }

    @Test
    void refuseNumbersWithWhichNoJobWouldGoOn() {
        assertThat(TestJob.run(JobOptions::idleTimeout, "copy", "--idle-timeout", "0s")
                        .err())
                .contains("--idle-timeout must be longer than 0");
        for (String count : List.of("0", "-3", "40000", "four")) {
            for (String option : List.of("--topic-partitions", "--topic-replication")) {
                assertThatThrownBy(() -> JobCommandLine.of(new TopicOptions()).parseArgs(option, count))
                        .isInstanceOf(ParameterException.class)
                        .hasMessageContainingAll(option, "'" + count + "' is not a whole number from 1 to 32767");
            }
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"committed", "earliest", "Latest"})
    void beginWhereTheCommandLineSays(String position) {
        assertThat(parsed("copy", "--from", position).from().kind().name()).isEqualToIgnoringCase(position);
    }

    @Test
    void endTheJarWithAFailureOfWhichFlinkPrintsTheMessageAlone() {
        assertThatThrownBy(() -> JobCommandLine.run(new TestJob.Copy(), options -> {}, "--no-such-option"))
                .isInstanceOf(ProgramParametrizationException.class)
                .hasMessage("The job was not started.");
    }

    private static JobOptions parsed(String... arguments) {
        List<JobOptions> seen = new ArrayList<>();
        TestJob.Outcome outcome = TestJob.run(seen::add, arguments);
        assertThat(outcome.exitCode()).as(outcome.err()).isZero();
        return seen.get(0);
    }
}
