package io.furrow.bench.command;

import java.io.PrintWriter;
import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.concurrent.Callable;

import org.apache.kafka.clients.admin.NewTopic;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.mission.MissionStart;
import io.furrow.cli.option.HelpOption;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.topic.Topics;

/** {@code ./furrow bench missions}. */
@Command(
        name = "missions",
        abbreviateSynopsis = true,
        description = {
            "Starts missions one after the other on a suite of this JVM, through the REST API, and prints how long it takes"
                    + " until their devices are provisioned, connected, and have reported.",
            "Exit code 0 means that the first data of each mission came within five seconds."
        })
final class MissionBench implements Callable<Integer> {
    private static final String DOMAIN = "bench";
    private static final Duration PROMISED = Duration.ofSeconds(5);

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--devices",
            paramLabel = "N",
            defaultValue = "100",
            description = "Devices of a mission. Default: ${DEFAULT-VALUE}.")
    private int devices;

    @Option(
            names = "--period",
            paramLabel = "DURATION",
            defaultValue = "1s",
            description = "Between two measures of a device. Default: ${DEFAULT-VALUE}.")
    private Duration period;

    @Option(
            names = "--timeout",
            paramLabel = "DURATION",
            defaultValue = "30s",
            description = "Longest wait for the next sign of a mission. Default: ${DEFAULT-VALUE}.")
    private Duration timeout;

    @Option(
            names = "--missions",
            paramLabel = "N",
            defaultValue = "5",
            description =
                    "How many are started and stopped, the first in a JVM that is cold. Default: ${DEFAULT-VALUE}.")
    private int missions;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        boolean kept = true;
        try (RunDirectory directory = RunDirectory.open(null);
                Suite suite = Suite.start(SuiteSettings.onFreePorts("10s"), directory, new Progress(out))) {
            suite.kafka()
                    .admin()
                    .createTopics(List.of(new NewTopic(Topics.realtime(DOMAIN), Optional.empty(), Optional.empty())))
                    .all()
                    .get();
            try (MissionStart start =
                    new MissionStart(suite.control(), suite.kafka().clientProperties(), DOMAIN)) {
                out.printf(
                        "%n  seconds from the request to  %8s %10s %10s %10s %10s%n",
                        "answer", "first raw", "all raw", "routed", "running");
                for (int i = 1; i <= missions; i++) {
                    String mission = "bench-" + i;
                    MissionStart.Delays delays = start.run(new MissionStart.Plan(mission, devices, period), timeout);
                    print(out, "mission %d of %d devices".formatted(i, devices), delays);
                    kept &= delays.firstRaw().compareTo(PROMISED) <= 0;
                    out.printf(
                            Locale.ROOT, "  %-28s %8.2f%n", "  stopped after", seconds(start.stop(mission, timeout)));
                }
            }
        }
        return kept ? 0 : 1;
    }

    private static void print(PrintWriter out, String name, MissionStart.Delays delays) {
        out.printf(
                Locale.ROOT,
                "  %-28s %8.2f %10.2f %10.2f %10.2f %10.2f%n",
                name,
                seconds(delays.answered()),
                seconds(delays.firstRaw()),
                seconds(delays.allRaw()),
                seconds(delays.firstRouted()),
                seconds(delays.running()));
        out.flush();
    }

    private static double seconds(Duration duration) {
        return duration.toMillis() / 1000.0;
    }
}
