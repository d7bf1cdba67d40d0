package io.furrow.bench.command;

import java.io.PrintWriter;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.fleet.FleetMeasurement;
import io.furrow.bench.fleet.FleetPlan;
import io.furrow.bench.fleet.FleetReport;
import io.furrow.cli.option.HelpOption;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.suite.Closeables;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.model.device.FarmSecret;

/** {@code ./furrow bench fleet}. */
@Command(
        name = "fleet",
        abbreviateSynopsis = true,
        description =
                "Runs wanted devices in a fleet that is a JVM of its own, counts what they report over MQTT, and prints"
                        + " its memory and processor time. Exit code 1 where a device is silent or measures are missing.")
final class FleetBench implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--devices",
            paramLabel = "N",
            defaultValue = "10000",
            description = "Thermometers. Default: ${DEFAULT-VALUE}.")
    private int devices;

    @Option(
            names = "--missions",
            paramLabel = "N",
            defaultValue = "10",
            description =
                    "Missions that they are on; beyond 500 devices each is a connection. Default: ${DEFAULT-VALUE}.")
    private int missions;

    @Option(
            names = "--period",
            paramLabel = "MS",
            defaultValue = "1000",
            description = "Milliseconds between two measures of a device. Default: ${DEFAULT-VALUE}.")
    private long period;

    @Option(
            names = "--heap",
            paramLabel = "MB",
            defaultValue = "256",
            description = "Most heap of the fleet's JVM. Default: ${DEFAULT-VALUE}.")
    private int heap;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            defaultValue = "20",
            description = "Seconds that do not count, once all run. Default: ${DEFAULT-VALUE}.")
    private long warmup;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            defaultValue = "60",
            description = "Seconds that count. Default: ${DEFAULT-VALUE}.")
    private long seconds;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        FleetPlan plan = new FleetPlan(
                devices,
                missions,
                Duration.ofMillis(period),
                heap,
                Duration.ofSeconds(warmup),
                Duration.ofSeconds(seconds));
        try (RunDirectory directory = RunDirectory.open(null);
                Closeables parts = directory.closingFirst(new Closeables())) {
            LogFile.writeTo(directory.resolve("furrow.log"));
            EmbeddedKafka kafka = parts.add("Kafka", EmbeddedKafka.start(directory.resolve("kafka")));
            EmbeddedMqtt mqtt = parts.add("MQTT", EmbeddedMqtt.start(passwords(plan)));
            FleetPlan.Ends ends = new FleetPlan.Ends(kafka.bootstrapServers(), mqtt.uri(), directory.path());
            FleetReport report = new FleetMeasurement(plan, ends).run();
            report.print(out);
            return report.holds() ? 0 : 1;
        }
    }

    /** What the control plane would make known to the broker. */
    private static Map<String, String> passwords(FleetPlan plan) {
        Map<String, String> passwords = new HashMap<>();
        passwords.put(FleetPlan.LISTENER, FleetPlan.LISTENER);
        FarmSecret secret = FleetPlan.secret();
        for (int i = 0; i < plan.missions(); i++) {
            String mission = plan.mission(i);
            add(passwords, secret.gateway(mission));
            for (int number = 1; number <= plan.devices() / plan.missions() + 1; number++) {
                add(passwords, secret.device(mission, "urn:ngsi-ld:Thermometer:" + mission + "-" + number));
            }
        }
        return passwords;
    }

    private static void add(Map<String, String> passwords, FarmSecret.Login login) {
        passwords.put(login.user(), login.password());
    }
}
