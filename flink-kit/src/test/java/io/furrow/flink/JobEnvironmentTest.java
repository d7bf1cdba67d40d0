package io.furrow.flink;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.configuration.ReadableConfig;
import org.junit.jupiter.api.Test;
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

    @Test
    void refusesAStrategyThatFlinkDoesNotHave() {
        assertThat(TestJob.run(options -> {}, "copy", "--restart-strategy", "sometimes")
                        .err())
                .contains("'sometimes' is no way to restart; write exponential-delay, fixed-delay or none");
    }

    private static ReadableConfig settings(String... arguments) {
        List<ReadableConfig> settings = new ArrayList<>();
        List<String> words = new ArrayList<>(List.of("copy"));
        words.addAll(List.of(arguments));
        TestJob.Outcome outcome = TestJob.run(
                options -> settings.add(JobEnvironment.create(options).getConfiguration()),
                words.toArray(String[]::new));
        assertThat(outcome.exitCode()).as(outcome.err()).isZero();
        return settings.get(0);
    }
}
