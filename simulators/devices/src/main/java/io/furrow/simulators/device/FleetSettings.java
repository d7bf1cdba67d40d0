package io.furrow.simulators.device;

import java.net.URI;

import io.furrow.model.file.AccessToken;

/**
 * The FIWARE endpoints of simulated devices, and their credentials.
 *
 * @param contextBroker base of the NGSI-v2 API, as in {@code http://127.0.0.1:1026}
 * @param iotAgent base of the provisioning API, as in {@code http://127.0.0.1:4041}
 * @param mqtt the MQTT broker, as in {@code tcp://127.0.0.1:1883}
 * @param mqttPassword left out of {@link #toString()}
 * @param fiwareService tenant; blank for the default one
 * @param servicePath {@code /} for the root
 * @param iotAgentResource of service groups, the IoT Agent's default resource; may be empty
 * @param token for a proxy that guards context broker and IoT Agent
 */
public record FleetSettings(
        URI contextBroker,
        URI iotAgent,
        URI mqtt,
        String mqttUser,
        String mqttPassword,
        String fiwareService,
        String servicePath,
        String iotAgentResource,
        AccessToken token) {
    public static final String DEFAULT_RESOURCE = "/iot/json";

    /** With the default resource, and without a token. */
    public FleetSettings(
            URI contextBroker,
            URI iotAgent,
            URI mqtt,
            String mqttUser,
            String mqttPassword,
            String fiwareService,
            String servicePath) {
        this(
                contextBroker,
                iotAgent,
                mqtt,
                mqttUser,
                mqttPassword,
                fiwareService,
                servicePath,
                DEFAULT_RESOURCE,
                AccessToken.NONE);
    }

    public FleetSettings withIotAgentResource(String resource) {
        return new FleetSettings(
                contextBroker, iotAgent, mqtt, mqttUser, mqttPassword, fiwareService, servicePath, resource, token);
    }

    public FleetSettings withToken(AccessToken newToken) {
        return new FleetSettings(
                contextBroker,
                iotAgent,
                mqtt,
                mqttUser,
                mqttPassword,
                fiwareService,
                servicePath,
                iotAgentResource,
                newToken);
    }

    @Override
    public String toString() {
        return "FleetSettings[contextBroker=%s, iotAgent=%s, mqtt=%s as %s, scope=%s %s]"
                .formatted(contextBroker, iotAgent, mqtt, mqttUser, fiwareService, servicePath);
    }
}
