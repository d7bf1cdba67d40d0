package io.furrow.simulators.host;

import java.net.URI;
import java.util.Properties;
import java.util.function.Supplier;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.file.AccessToken;
import io.furrow.simulators.mqtt.MqttAccess;

/**
 * Settings of a host of simulated devices.
 *
 * @param kafka settings of Kafka clients, including {@code bootstrap.servers}
 * @param mqtt the MQTT broker of the devices
 * @param contextBroker base of the NGSI-v2 API that robots write to, as in {@code http://127.0.0.1:1026}
 * @param secret source of API keys and passwords, the same as the control plane's; polled for changes
 * @param token for a proxy that guards the context broker
 * @param seed other seeds create other devices: elsewhere in their area, other noise
 */
public record HostSettings(
        Properties kafka,
        MqttAccess mqtt,
        URI contextBroker,
        Supplier<FarmSecret> secret,
        AccessToken token,
        long seed) {
    /** Without a token, with the seed 0. */
    public static HostSettings of(Properties kafka, MqttAccess mqtt, URI contextBroker, Supplier<FarmSecret> secret) {
        return new HostSettings(kafka, mqtt, contextBroker, secret, AccessToken.NONE, 0);
    }

    public HostSettings withToken(AccessToken newToken) {
        return new HostSettings(kafka, mqtt, contextBroker, secret, newToken, seed);
    }
}
