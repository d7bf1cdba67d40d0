package io.furrow.bench.evaluation;

import java.util.Properties;

import io.furrow.launcher.suite.Suite;
import io.furrow.simulators.device.FleetSettings;

/**
 * A suite that is evaluated.
 *
 * @param devices where loads go in
 * @param kafka settings of a client of the Kafka at which they come out
 * @param isOurs whether it runs in this JVM, so that its processor time and memory can be told
 */
public record Target(FleetSettings devices, Properties kafka, boolean isOurs) {
    static Target of(Suite suite) {
        return new Target(suite.devices(), suite.kafka().clientProperties(), true);
    }
}
