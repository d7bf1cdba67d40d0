package io.furrow.simulators.host;

import java.net.URI;
import java.util.Objects;
import java.util.Properties;
import java.util.function.Supplier;

import io.furrow.model.device.FarmSecret;
import io.furrow.simulators.mqtt.MqttAccess;

/**
 * What a host of simulated devices is started with.
 *
 * @param kafka settings of Kafka clients, {@code bootstrap.servers} among them
 * @param mqtt the MQTT broker that devices speak to
 * @param contextBroker base of the NGSI-v2 interface that robots write to, as in {@code http://127.0.0.1:1026}
 * @param secret of which the API keys of missions and the passwords of devices are made, as at the control plane; asked often, and
 *     followed when it changes
 * @param seed other seeds make other devices: elsewhere in their area, other noise
 */
public record HostSettings(
        Properties kafka, MqttAccess mqtt, URI contextBroker, Supplier<FarmSecret> secret, long seed) {
    public HostSettings {
        Objects.requireNonNull(kafka);
        Objects.requireNonNull(mqtt);
        Objects.requireNonNull(contextBroker);
        Objects.requireNonNull(secret);
    }

    /** With the seed 0. */
    public static HostSettings of(Properties kafka, MqttAccess mqtt, URI contextBroker, Supplier<FarmSecret> secret) {
        return new HostSettings(kafka, mqtt, contextBroker, secret, 0);
    }
}
