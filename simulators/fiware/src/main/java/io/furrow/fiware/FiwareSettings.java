package io.furrow.fiware;

import java.net.URI;
import java.nio.file.Path;
import java.util.Objects;

import io.furrow.http.AllowedNames;

/**
 * Settings of a stand-in.
 *
 * @param contextBrokerPort of the NGSI-v2 API on 127.0.0.1; 0 for a free one
 * @param iotAgentPort of the provisioning API on 127.0.0.1; 0 for a free one
 * @param mqttBroker {@code tcp://host:port}; null without MQTT
 * @param mqttUser null without authentication
 * @param mqttPassword null without authentication
 * @param state file for entities, subscriptions, service groups and devices, created on the first change; null for
 *     memory only
 * @param connections to the receivers of notifications
 * @param allowed hosts and origins of both APIs besides loopback
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
        /** Reused for the next notification; the default here, to save connects. */
        PERSISTENT,
        /** One per notification: Orion's default. */
        TRANSIENT
    }

    public FiwareSettings {
        if (mqttUser != null) {
            Objects.requireNonNull(mqttPassword, "an MQTT user needs a password");
        }
        Objects.requireNonNull(connections);
        Objects.requireNonNull(allowed);
    }

    /** In memory, without a state file. */
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

    public FiwareSettings withState(Path file) {
        return new FiwareSettings(
                contextBrokerPort, iotAgentPort, mqttBroker, mqttUser, mqttPassword, file, connections, allowed);
    }

    /** Changes the port of the context broker; 0 for a free one. */
    public FiwareSettings withContextBrokerPort(int port) {
        return new FiwareSettings(port, iotAgentPort, mqttBroker, mqttUser, mqttPassword, state, connections, allowed);
    }

    public FiwareSettings withConnections(Connections others) {
        return new FiwareSettings(
                contextBrokerPort, iotAgentPort, mqttBroker, mqttUser, mqttPassword, state, others, allowed);
    }

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
