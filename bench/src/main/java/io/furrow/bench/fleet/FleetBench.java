package io.furrow.bench.fleet;

import java.nio.charset.StandardCharsets;
import java.util.HashMap;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;
import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.model.device.FarmSecret;

/** {@code ./furrow bench fleet}. */
@Command(
        name = "fleet",
        description = "Runs desired devices in a fleet in a separate JVM, counts their MQTT measures, and prints the "
                + "memory and CPU time of the fleet. Exit code 1 where a device is silent or measures are missing.")
public final class FleetBench extends Benchmark {
    @Option(names = "--devices", paramLabel = "N", description = "Thermometers. " + DEFAULT)
    int devices = 10_000;

    @Option(
            names = "--missions",
            paramLabel = "N",
            description = "Missions that they are on; beyond 500 devices each is a connection. " + DEFAULT)
    int missions = 10;

    @Option(
            names = "--period",
            paramLabel = "MS",
            description = "Milliseconds between two measures of a device. " + DEFAULT)
    long period = 1000;

    @Option(names = "--heap", paramLabel = "MB", description = "Most heap of the fleet's JVM. " + DEFAULT)
    int heap = 256;

    @Option(names = "--warmup", paramLabel = "S", description = "Seconds that do not count, once all run. " + DEFAULT)
    long warmup = 20;

    @Option(names = "--seconds", paramLabel = "S", description = "Seconds that count. " + DEFAULT)
    long seconds = 60;

    @Override
    public Integer call() throws Exception {
        try (Engines engines = Engines.in(null, out()).kafka()) {
            EmbeddedMqtt mqtt = engines.start("MQTT", () -> EmbeddedMqtt.start(passwords()));
            Figures figures = new Figures("%d devices on %d missions, one measure per %d ms each, %d MB of heap"
                    .formatted(devices, missions, period, heap));
            boolean complete = new FleetMeasurement(this, engines, mqtt.uri()).run(figures);
            print(figures);
            return complete ? 0 : 1;
        }
    }

    static String mission(int number) {
        return "bench-" + number;
    }

    /** The accounts that the control plane would create in the broker. */
    private Map<String, String> passwords() {
        Map<String, String> passwords = new HashMap<>();
        passwords.put(MeasureListener.USER, MeasureListener.USER);
        FarmSecret secret = new FarmSecret(HostProcess.SECRET.getBytes(StandardCharsets.UTF_8));
        for (int i = 0; i < missions; i++) {
            String mission = mission(i);
            add(passwords, secret.gateway(mission));
            for (int number = 1; number <= devices / missions + 1; number++) {
                add(passwords, secret.device(mission, "urn:ngsi-ld:Thermometer:" + mission + "-" + number));
            }
        }
        return passwords;
    }

    private static void add(Map<String, String> passwords, FarmSecret.Login login) {
        passwords.put(login.user(), login.password());
    }
}
