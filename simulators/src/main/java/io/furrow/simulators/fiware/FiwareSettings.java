package io.furrow.simulators.fiware;

import java.net.URI;
import java.nio.file.Path;
import java.util.Objects;

import io.furrow.http.AllowedNames;

/**
 * Where a stand-in listens, which MQTT broker its agent uses, where it keeps its state, and how it connects to receivers.
 *
 * @param contextBrokerPort of the NGSI-v2 API on 127.0.0.1; 0 for a free one
 * @param iotAgentPort of the provisioning API on 127.0.0.1; 0 for a free one
 * @param mqttBroker {@code tcp://host:port}; null for an agent that is only provisioned and hears no device
 * @param mqttUser null where the broker wants none
 * @param mqttPassword null where the broker wants none
 * @param state the file that entities, subscriptions, service groups and devices outlive a restart in, made when there is
 *     something to keep; null for memory only
 * @param connections to the receivers of notifications
 * @param allowed hosts and origins of both APIs beside loopback
 */
public record FiwareSettings(
        int contextBrokerPort,
        int iotAgentPort,
        URI mqttBroker,
        String mqttUser,
        String mqttPassword,
        Path state,
        Connections connections,
        AllowedNames allowed) {
    /** Orion's {@code -notificationMode}, as far as a receiver sees it. */
    public enum Connections {
        /** Kept for the next notification; the default here, for a machine that has more to do than to connect. */
        PERSISTENT,
        /** A new one for each notification: Orion's default. */
        TRANSIENT
    }

    public FiwareSettings {
        if (mqttUser != null) {
            Objects.requireNonNull(mqttPassword, "an MQTT user needs a password");
        }
        Objects.requireNonNull(connections);
        Objects.requireNonNull(allowed);
    }

    /** Without state: all is gone when it is closed. */
    public FiwareSettings(
            int contextBrokerPort, int iotAgentPort, URI mqttBroker, String mqttUser, String mqttPassword) {
        this(
                contextBrokerPort,
                iotAgentPort,
                mqttBroker,
                mqttUser,
                mqttPassword,
                null,
                Connections.PERSISTENT,
                AllowedNames.NONE);
    }

    /** The same with a state file. */
    public FiwareSettings withState(Path file) {
        return new FiwareSettings(
                contextBrokerPort, iotAgentPort, mqttBroker, mqttUser, mqttPassword, file, connections, allowed);
    }

    /** The same with the context broker on another port; 0 for a free one. */
    public FiwareSettings withContextBrokerPort(int port) {
        return new FiwareSettings(port, iotAgentPort, mqttBroker, mqttUser, mqttPassword, state, connections, allowed);
    }

    /** The same with other connections to receivers. */
    public FiwareSettings withConnections(Connections others) {
        return new FiwareSettings(
                contextBrokerPort, iotAgentPort, mqttBroker, mqttUser, mqttPassword, state, others, allowed);
    }

    /** The same for further hosts and origins. */
    public FiwareSettings withAllowed(AllowedNames names) {
        return new FiwareSettings(
                contextBrokerPort, iotAgentPort, mqttBroker, mqttUser, mqttPassword, state, connections, names);
    }

    /** Free ports and no MQTT. */
    public static FiwareSettings httpOnly() {
        return new FiwareSettings(0, 0, null, null, null);
    }

    @Override
    public String toString() {
        return "FiwareSettings[contextBrokerPort=" + contextBrokerPort + ", iotAgentPort=" + iotAgentPort
                + ", mqttBroker=" + mqttBroker + ", mqttUser=" + mqttUser + ", state=" + state + ", connections="
                + connections + "]";
    }
}
