package io.furrow.flink.job;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.function.Supplier;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.ReadableConfig;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class JobEnvironmentTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", textBlock = """
                                                              | restart-strategy.type                               | exponential-delay
                                                              | restart-strategy.exponential-delay.initial-backoff  | 1 s
                    --restart-delay 3s --restart-delay-max 30s | restart-strategy.exponential-delay.initial-backoff  | 3 s
                    --restart-delay 3s --restart-delay-max 30s | restart-strategy.exponential-delay.max-backoff      | 30 s
                    --restart-delay 3s --restart-delay-max 1s  | restart-strategy.exponential-delay.max-backoff      | 3 s
                    --restart-attempts 5                       | restart-strategy.exponential-delay.attempts-before-reset-backoff | 5
                    --restart-strategy fixed-delay             | restart-strategy.type                               | fixed-delay
                    --restart-strategy fixed-delay --restart-attempts 7 | restart-strategy.fixed-delay.attempts     | 7
                    --restart-strategy none                    | restart-strategy.type                               | none
                    --unaligned-checkpoints                    | execution.checkpointing.unaligned.enabled           | true
                                                              | execution.checkpointing.unaligned.enabled           | -
                    --state-backend rocksdb                    | state.backend.type                                  | rocksdb
                    --state-backend rocksdb                    | execution.checkpointing.incremental                 | true
                                                              | state.backend.type                                  | -
                    """)
    void setsWhatTheOptionsSay(String options, String key, String value) {
        ReadableConfig settings = settings(options == null ? new String[0] : options.split(" "));

        assertThat(settings.toMap().get(key)).isEqualTo(value);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", textBlock = """
            -                          | execution.checkpointing.interval                 | 42 s
            --checkpoint-interval 3s   | execution.checkpointing.interval                 | 3 s
            -                          | restart-strategy.type                            | failure-rate
            -                          | restart-strategy.exponential-delay.max-backoff   | -
            --restart-delay 3s         | restart-strategy.type                            | exponential-delay
            --restart-delay 3s         | restart-strategy.exponential-delay.attempts-before-reset-backoff | 2147483647
            -                          | pipeline.object-reuse                            | false
            -                          | pipeline.name                                    | cluster's
            --name mine                | pipeline.name                                    | mine
            -                          | execution.checkpointing.externalized-checkpoint-retention | DELETE_ON_CANCELLATION
            -                          | execution.buffer-timeout.interval                | 77 ms
            -                          | pipeline.max-parallelism                         | 720
            """)
    void leavesToTheClusterWhatTheOptionsDoNotSay(String options, String key, String value) {
        ReadableConfig settings =
                onClusterWith(CLUSTER, () -> settings(options == null ? new String[0] : options.split(" ")));

        assertThat(settings.toMap().get(key)).isEqualTo(value);
    }

    @Test
    void showsWhereEachSettingIsFrom() {
        Map<String, String> shown = onClusterWith(
                CLUSTER,
                () -> environment("--restart-strategy", "none")
                        .getConfig()
                        .getGlobalJobParameters()
                        .toMap());

        assertThat(shown)
                .containsEntry("execution.checkpointing.interval", "42 s (cluster)")
                .containsEntry("restart-strategy.type", "none (option)")
                .containsEntry("pipeline.object-reuse", "false (cluster)")
                .containsEntry("--restart-strategy", "none");
        assertThat(environment("--checkpoint-dir", "s3://key:secret@store/c")
                        .getConfig()
                        .getGlobalJobParameters()
                        .toMap())
                .containsEntry("execution.checkpointing.interval", "10 s (default)")
                .containsEntry("execution.checkpointing.dir", "s3://***@store/c (option)");
    }

    @Test
    void limitsRestoredEventTimeExceptForReplays() {
        assertThat(parameters("--clock-skew", "7s")).containsEntry(JobEnvironment.MAX_RESTORED_AHEAD, "PT7S");
        assertThat(parameters("--input", "data.hoeing.replay.0123abcd"))
                .doesNotContainKey(JobEnvironment.MAX_RESTORED_AHEAD);
    }

    private static Map<String, String> parameters(String... arguments) {
        return environment(arguments).getConfig().getGlobalJobParameters().toMap();
    }

    @TempDir
    private Path folder;

    private static final Map<String, String> CLUSTER = Map.of(
            "execution.checkpointing.interval", "42 s",
            "restart-strategy.type", "failure-rate",
            "restart-strategy.exponential-delay.attempts-before-reset-backoff", "2",
            "pipeline.object-reuse", "false",
            "pipeline.name", "cluster's",
            "pipeline.max-parallelism", "8",
            "execution.buffer-timeout.interval", "77 ms",
            "execution.checkpointing.externalized-checkpoint-retention", "DELETE_ON_CANCELLATION");

    /** As a client of a cluster, where {@code -D} and the configuration come together. */
    private static <T> T onClusterWith(Map<String, String> configuration, Supplier<T> client) {
        return Cluster.with(Configuration.fromMap(configuration), client);
    }

    /** The context in which Flink's client runs a program. */
    @SuppressWarnings("try") // close() may be interrupted, as every environment's may
    private static final class Cluster extends StreamExecutionEnvironment {
        private Cluster(Configuration configuration) {
            super(configuration);
        }

        static <T> T with(Configuration configuration, Supplier<T> client) {
            initializeContextEnvironment(settings -> new Cluster(configuration.clone()));
            try {
                return client.get();
            } finally {
                resetContextEnvironment();
            }
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", textBlock = """
            --checkpoint-interval 15min | 10s   | -       | checkpoints are 900 s apart, and the broker ends transactions after 600 s
            --checkpoint-interval 541s  | 10s   | -       | checkpoints are 541 s apart
            --checkpoint-interval 540s  | 10s   | -       | -
            --checkpoint-interval 15min | 10s   | 960000  | -
            --checkpoint-interval 10s   | 10s   | 60000   | transactions after 60 s
            --parallelism 1             | 15min | -       | checkpoints are 900 s apart
            --parallelism 1             | 15min | 10m     | transaction.timeout.ms '10m' is not a whole number; write milliseconds
            """)
    void refusesTransactionsThatEndBeforeTheirCheckpoint(String option, String ofCluster, String timeout, String why)
            throws Exception {
        Path file = Files.writeString(
                folder.resolve("kafka.properties"), timeout == null ? "" : "transaction.timeout.ms=" + timeout);
        String[] words = ("copy --delivery exactly-once --kafka-properties " + file + " " + option).split(" ");

        TestJob.Outcome outcome = onClusterWith(
                Map.of("execution.checkpointing.interval", ofCluster),
                () -> TestJob.run(JobEnvironment::create, words));

        assertThat(outcome.exitCode()).isEqualTo(why == null ? 0 : 2);
        assertThat(outcome.err()).contains(why == null ? "" : why);
    }

    @Test
    void refusesAStrategyThatFlinkDoesNotHave() {
        assertThat(TestJob.run(options -> {}, "copy", "--restart-strategy", "sometimes")
                        .err())
                .contains("'sometimes' is not a way to restart; write exponential-delay, fixed-delay or none");
    }

    private static ReadableConfig settings(String... arguments) {
        return environment(arguments).getConfiguration();
    }

    private static StreamExecutionEnvironment environment(String... arguments) {
        List<StreamExecutionEnvironment> made = new ArrayList<>();
        List<String> words = new ArrayList<>(List.of("copy"));
        words.addAll(List.of(arguments));
        TestJob.Outcome outcome =
                TestJob.run(options -> made.add(JobEnvironment.create(options)), words.toArray(String[]::new));
        assertThat(outcome.exitCode()).as(outcome.err()).isZero();
        return made.get(0);
    }
}
