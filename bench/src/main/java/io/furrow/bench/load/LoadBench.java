package io.furrow.bench.load;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.launcher.suite.Suite;
import io.furrow.simulators.load.LoadPlan;

/** {@code ./furrow bench load}. */
@Command(
        name = "load",
        description =
                "Sends the load of many devices over MQTT through the embedded suite and prints what arrived and the "
                        + "delay of each hop.")
public final class LoadBench extends Benchmark {
    private static final String DOMAIN = "bench";
    /** A cold JVM cannot take the full load: it gets a quarter of it, a half, then all. */
    private static final int WARM_UP_STEPS = 4;

    @Option(names = "--devices", paramLabel = "N", description = "Devices. " + DEFAULT)
    private int devices = 625;

    @Option(
            names = "--period",
            paramLabel = "MS",
            description = "Milliseconds between two messages of a device. " + DEFAULT)
    private long period = 1000;

    @Option(names = "--payload", paramLabel = "BYTES", description = "Length of a message's payload. " + DEFAULT)
    private int payload = 1000;

    @Option(names = "--seconds", paramLabel = "S", description = "How long to send. " + DEFAULT)
    private long seconds = 60;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            description = "Seconds before it that are not counted: a quarter, half and all of the load. " + DEFAULT)
    private long warmup = 40;

    @Option(
            names = "--skip",
            paramLabel = "S",
            description = "Of --seconds, those whose delays do not count; with --warmup 0 a cold start. " + DEFAULT)
    private long skip;

    @Option(names = "--csv", paramLabel = "FILE", description = "Also write the figures here.")
    private Path csv;

    @Override
    public Integer call() throws Exception {
        return onSuite(null, this::measure);
    }

    private int measure(Suite suite) throws Exception {
        LoadMeasurement measurement =
                new LoadMeasurement(suite.devices(), suite.kafka().clientProperties(), this::say);
        for (int share = WARM_UP_STEPS; warmup > 0 && share >= 1; share /= 2) {
            long lasting = Math.max(1, warmup / WARM_UP_STEPS);
            measurement.run(plan(Math.max(1, devices / share), lasting, "warmup-" + share));
        }
        LoadReport report = measurement.run(plan(devices, seconds, "load"), Duration.ofSeconds(skip));
        report.print(out());
        if (csv != null) {
            Files.writeString(csv, report.csv());
        }
        return report.delivered() == report.sent() ? 0 : 1;
    }

    private LoadPlan plan(int senders, long lasting, String mission) {
        return new LoadPlan(senders, Duration.ofMillis(period), payload, Duration.ofSeconds(lasting), DOMAIN, mission);
    }
}
