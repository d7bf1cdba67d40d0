package io.furrow.simulators.fiware;

import java.net.URI;
import java.util.Objects;

/**
 * Where a stand-in listens and which MQTT broker its agent uses.
 *
 * @param contextBrokerPort of the NGSI-v2 API on 127.0.0.1; 0 for a free one
 * @param iotAgentPort of the provisioning API on 127.0.0.1; 0 for a free one
 * @param mqttBroker {@code tcp://host:port}; null for an agent that is only provisioned and hears no device
 * @param mqttUser null where the broker wants none
 * @param mqttPassword null where the broker wants none
 */
public record FiwareSettings(
        int contextBrokerPort, int iotAgentPort, URI mqttBroker, String mqttUser, String mqttPassword) {
    public FiwareSettings {
        if (mqttUser != null) {
            Objects.requireNonNull(mqttPassword, "an MQTT user needs a password");
        }
    }

    /** Free ports and no MQTT. */
    public static FiwareSettings httpOnly() {
        return new FiwareSettings(0, 0, null, null, null);
    }

    @Override
    public String toString() {
        return "FiwareSettings[contextBrokerPort=" + contextBrokerPort + ", iotAgentPort=" + iotAgentPort
                + ", mqttBroker=" + mqttBroker + ", mqttUser=" + mqttUser + "]";
    }
}
