package io.furrow.launcher;

import java.net.URI;
import java.nio.file.Path;

/**
 * How a suite is to be started.
 *
 * @param kafkaProperties for every Kafka client; null for none
 * @param fiwareService tenant
 * @param window of the temperature job, for instance {@code 10s}
 * @param fields a file; null for what is on the topic, or on an own broker without fields for the demonstration farm's
 * @param orion a context broker that already runs; null to start the stand-in
 * @param kafka bootstrap servers that already run; null to start a broker
 * @param mongo URI of a MongoDB that already runs; null to start a server
 */
public record SuiteSettings(
        Path kafkaProperties,
        String fiwareService,
        String window,
        Path fields,
        Ports ports,
        URI orion,
        String kafka,
        String mongo) {

    /** Ports on 127.0.0.1, each 0 for a free one. */
    public record Ports(int kafka, int connect, int flink, int listener, int mqtt, int orion, int iotAgent, int mongo) {
        /** All free ones. */
        public static Ports free() {
            return new Ports(0, 0, 0, 0, 0, 0, 0, 0);
        }
    }

    /** A suite on free ports with its own engines and the stand-in, as tests and measurements want it. */
    public static SuiteSettings onFreePorts(String window) {
        return new SuiteSettings(null, "farm", window, null, Ports.free(), null, null, null);
    }
}
