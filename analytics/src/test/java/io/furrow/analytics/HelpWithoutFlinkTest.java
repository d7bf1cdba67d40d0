package io.furrow.analytics;

import java.io.File;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import picocli.CommandLine;

import io.furrow.flink.job.JobOptions;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;
import io.furrow.process.TestProcess;
import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;

/** In a process of its own, whose class path has neither Flink nor Kafka nor JTS. */
@Timeout(60)
class HelpWithoutFlinkTest {
    @Test
    void explainsTheOptionsOfTheTemperatureJob() throws Exception {
        TestProcess.Ended help = analytics("temperature", "--help");

        assertThat(help.output())
                .contains("""
                                --fields=FILE --fields-topic=TOPIC --window=DURATION --suspect-floor=NUMBER
                                --delivery=MODE""".split("\\s+"))
                .contains("Default: 1min.", "Default: data.temperature.")
                .doesNotContain("Exception");
        assertThat(help.status()).isZero();
    }

    @Test
    void explainsTheOptionsOfThePresenceJob() throws Exception {
        TestProcess.Ended help = analytics("presence", "--help");

        assertThat(help.output().replaceAll("\\s+", " "))
                .contains("--fields-topic=TOPIC", "--dwell=DURATION", "--time-to-live=DURATION")
                .contains("Default: 5min.", "Default: data.presence.")
                .doesNotContain("Exception");
        assertThat(help.status()).isZero();
    }

    @Test
    void namesTheJobs() throws Exception {
        TestProcess.Ended help = analytics("--help");

        assertThat(help.output()).contains(AnalyticsKind.jobNames()).doesNotContain("Exception");
        assertThat(help.status()).isZero();
    }

    @Test
    void saysWhatIsMissing() throws Exception {
        TestProcess.Ended refused = analytics("temperature", "--fields");

        assertThat(refused.output()).contains("Missing required parameter for option '--fields'");
        assertThat(refused.status()).isNotZero();
    }

    private static TestProcess.Ended analytics(String... args) throws Exception {
        List<String> command = new ArrayList<>(
                List.of(TestProcess.program("java"), "-cp", classPath(), AnalyticsJobs.class.getName()));
        command.addAll(List.of(args));
        return TestProcess.run(new ProcessBuilder(command));
    }

    private static String classPath() {
        return Stream.of(AnalyticsJobs.class, JobOptions.class, Topics.class, CommandLine.class)
                .map(HelpWithoutFlinkTest::origin)
                .collect(Collectors.joining(File.pathSeparator));
    }

    private static String origin(Class<?> type) {
        return Unchecked.get(() -> Path.of(
                        type.getProtectionDomain().getCodeSource().getLocation().toURI())
                .toString());
    }
}
