package io.furrow.bench.mission;

import java.time.Duration;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.launcher.suite.Suite;
import io.furrow.model.topic.Topics;

/** {@code ./furrow bench missions}. */
@Command(
        name = "missions",
        description = {
            "Starts missions one after the other on a suite of this JVM, through the REST API, and prints how long it takes"
                    + " until their devices are provisioned, connected, and have reported.",
            "Exit code 0 means that the first data of each mission came within five seconds."
        })
public final class MissionBench extends Benchmark {
    private static final String DOMAIN = "bench";
    private static final Duration PROMISED = Duration.ofSeconds(5);

    @Option(names = "--devices", paramLabel = "N", description = "Devices of a mission. " + DEFAULT)
    private int devices = 100;

    @Option(
            names = "--period",
            paramLabel = "DURATION",
            defaultValue = "1s",
            description = "Between two measures of a device. " + DEFAULT)
    private Duration period;

    @Option(
            names = "--timeout",
            paramLabel = "DURATION",
            defaultValue = "30s",
            description = "Longest wait for the next sign of a mission. " + DEFAULT)
    private Duration timeout;

    @Option(
            names = "--missions",
            paramLabel = "N",
            description = "How many are started and stopped, the first in a JVM that is cold. " + DEFAULT)
    private int missions = 5;

    @Override
    public Integer call() throws Exception {
        return onSuite(null, this::measure);
    }

    private int measure(Suite suite) throws Exception {
        boolean inTime = true;
        Engines.makeTopics(
                suite.kafka().clientProperties(), EmbeddedKafka.PARTITIONS, Map.of(), Topics.realtime(DOMAIN));
        Figures figures = new Figures("seconds from the request");
        try (MissionStart start =
                new MissionStart(suite.control(), suite.kafka().clientProperties(), DOMAIN)) {
            for (int i = 1; i <= missions; i++) {
                String mission = "bench-" + i;
                MissionStart.Delays delays = start.run(new MissionStart.Plan(mission, devices, period), timeout);
                inTime &= delays.firstRaw().compareTo(PROMISED) <= 0;
                Duration stopped = start.stop(mission, timeout);
                say("mission %d of %d".formatted(i, missions));
                figures.add(
                        "to", "mission %d of %d devices".formatted(i, devices),
                        "answer", seconds(delays.answered()),
                        "first raw", seconds(delays.firstRaw()),
                        "all raw", seconds(delays.allRaw()),
                        "routed", seconds(delays.firstRouted()),
                        "running", seconds(delays.running()),
                        "stopped", seconds(stopped));
            }
        }
        print(figures);
        return inTime ? 0 : 1;
    }

    private static double seconds(Duration duration) {
        return duration.toMillis() / 1000.0;
    }
}
