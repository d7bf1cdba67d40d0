package io.furrow.launcher.command;

import java.io.IOException;
import java.io.InputStream;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.launcher.option.FiwareOptions;
import io.furrow.launcher.process.ClockWatch;
import io.furrow.model.text.Counts;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.fleet.FarmFleet;
import io.furrow.simulators.fleet.FleetAccess;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.scenario.Farm;

/** {@code ./furrow scenario}. */
@Command(
        name = "scenario",
        abbreviateSynopsis = true,
        sortOptions = false,
        description = {
            "Runs the devices of a scenario file, without a control plane: provisions them at the IoT Agent, "
                    + "connects them and lets them report, by default to ./furrow demo on this machine.",
            "The format is described in simulators/README.md."
        })
public final class ScenarioCommand implements Callable<Integer> {
    private static final Duration DRAIN_TIMEOUT = Duration.ofSeconds(10);

    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "FILE", description = "The scenario, JSON.")
    private Path file;

    @Mixin
    private FiwareOptions fiware;

    @Option(
            names = "--mqtt-trusted",
            paramLabel = "FILE",
            description = "PEM file with the certificates to trust. Default: those that Java trusts.")
    private Path trusted;

    @Option(
            names = "--qos",
            paramLabel = "N",
            description = "QoS of measures: 0, measures are lost while the connection is broken; or 1. Default: 1.")
    private int qos = 1;

    @Option(
            names = "--for",
            paramLabel = "DURATION",
            description =
                    "Stop after this, for instance 10m, and wait until the broker has all measures. Default: at Ctrl-C.")
    private Duration howLong;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws InterruptedException {
        try {
            return run(farm(), access());
        } catch (IllegalArgumentException
                | IOException e) { // a wrong option; a file, an agent or a broker that refuses
            throw new CommandException(e.getMessage(), e);
        }
    }

    private int run(Farm farm, FleetAccess access) throws IOException, InterruptedException {
        PrintWriter out = spec.commandLine().getOut();
        CountDownLatch stop = new CountDownLatch(1);
        CountDownLatch stopped = new CountDownLatch(1);
        Thread hook = new Thread(() -> stopFromOutside(stop, stopped), "stop");
        Runtime.getRuntime().addShutdownHook(hook);
        try (FarmFleet fleet = FarmFleet.start(farm, access)) {
            out.printf("Runs %s; Ctrl-C stops them.%n", Counts.of(farm.devices().size(), "device"));
            ClockWatch clock = new ClockWatch(); // reports are due by the wall clock
            long end = howLong == null ? Long.MAX_VALUE : System.nanoTime() + howLong.toNanos();
            while (System.nanoTime() < end && !stop.await(1, TimeUnit.SECONDS)) {
                clock.check();
                out.printf("\r  %,d reports, %,d connections", fleet.reports(), fleet.connections());
                out.flush();
            }
            boolean drained = fleet.drain(DRAIN_TIMEOUT);
            FarmFleet.Tally tally = fleet.tally();
            out.printf(
                    "%n%,d reports, %,d acknowledged by the MQTT broker, %,d open, %,d dropped%n",
                    fleet.reports(), tally.acknowledged(), tally.open(), tally.dropped());
            out.flush();
            return drained && tally.dropped() == 0 ? 0 : 1;
        } finally {
            stopped.countDown();
        }
    }

    private static void stopFromOutside(CountDownLatch stop, CountDownLatch stopped) {
        stop.countDown();
        try {
            stopped.await(DRAIN_TIMEOUT.toMillis(), TimeUnit.MILLISECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private Farm farm() throws IOException {
        if (!Files.isReadable(file)) {
            throw new CommandException("%s cannot be read; name a scenario file".formatted(file), null);
        }
        try (InputStream json = Files.newInputStream(file)) {
            return Farm.read(json, Instant.now());
        }
    }

    private FleetAccess access() throws IOException {
        FleetSettings settings = fiware.settings();
        return new FleetAccess(
                settings,
                new MqttAccess(settings.mqtt(), trusted, qos),
                FleetAccess.Logins.all(new MqttAccess.Login(settings.mqttUser(), settings.mqttPassword())));
    }
}
