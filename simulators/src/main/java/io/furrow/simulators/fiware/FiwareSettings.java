package io.furrow.simulators.fiware;

import java.net.URI;
import java.nio.file.Path;
import java.util.Objects;

/**
 * Where a stand-in listens, which MQTT broker its agent uses, and where it keeps its state.
 *
 * @param contextBrokerPort of the NGSI-v2 API on 127.0.0.1; 0 for a free one
 * @param iotAgentPort of the provisioning API on 127.0.0.1; 0 for a free one
 * @param mqttBroker {@code tcp://host:port}; null for an agent that is only provisioned and hears no device
 * @param mqttUser null where the broker wants none
 * @param mqttPassword null where the broker wants none
 * @param state the file that entities, subscriptions, service groups and devices outlive a restart in, made when there is
 *     something to keep; null for memory only
 */
public record FiwareSettings(
        int contextBrokerPort, int iotAgentPort, URI mqttBroker, String mqttUser, String mqttPassword, Path state) {
    public FiwareSettings {
        if (mqttUser != null) {
            Objects.requireNonNull(mqttPassword, "an MQTT user needs a password");
        }
    }

    /** Without state: all is gone when it is closed. */
    public FiwareSettings(
            int contextBrokerPort, int iotAgentPort, URI mqttBroker, String mqttUser, String mqttPassword) {
        this(contextBrokerPort, iotAgentPort, mqttBroker, mqttUser, mqttPassword, null);
    }

    /** The same with a state file. */
    public FiwareSettings withState(Path file) {
        return new FiwareSettings(contextBrokerPort, iotAgentPort, mqttBroker, mqttUser, mqttPassword, file);
    }

    /** Free ports and no MQTT. */
    public static FiwareSettings httpOnly() {
        return new FiwareSettings(0, 0, null, null, null);
    }

    @Override
    public String toString() {
        return "FiwareSettings[contextBrokerPort=" + contextBrokerPort + ", iotAgentPort=" + iotAgentPort
                + ", mqttBroker=" + mqttBroker + ", mqttUser=" + mqttUser + ", state=" + state + "]";
    }
}
