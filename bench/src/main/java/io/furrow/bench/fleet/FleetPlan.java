package io.furrow.bench.fleet;

import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;

import io.furrow.model.device.FarmSecret;

/**
 * A fleet to be measured.
 *
 * @param devices thermometers, spread over the missions
 * @param period of each
 * @param heapMb most heap of the fleet's JVM
 * @param warmup after all run, before figures count
 * @param measured how long they count
 */
public record FleetPlan(int devices, int missions, Duration period, int heapMb, Duration warmup, Duration measured) {
    /** Of the farm that is made up. */
    public static final String SECRET = "bench bench bench bench";

    /** User of the MQTT broker that hears all, and its password. */
    public static final String LISTENER = "bench-listener";

    /** Where things are: Kafka and MQTT run already, files may be written to the folder. */
    public record Ends(String kafka, URI mqtt, Path folder) {}

    public String mission(int number) {
        return "bench-" + number;
    }

    public static FarmSecret secret() {
        return new FarmSecret(SECRET.getBytes(StandardCharsets.UTF_8));
    }
}
