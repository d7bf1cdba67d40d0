package io.furrow.simulators.fiware;

import java.net.URI;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.fiware.EntityUpdate.Options;

/**
 * What the IoT agent does between devices and the context broker: measures become updates of entities, the first one makes the entity;
 * updates of command attributes become messages to devices, with {@code <command>_status} {@code PENDING} until the device answers, then {@code OK}.
 */
final class IotAgent implements ContextBroker.Commands {
    /** The way to a device. */
    interface Downlink {
        /** @return whether the message is on its way */
        boolean send(String apikey, String deviceId, byte[] command);
    }

    private static final Logger LOG = LoggerFactory.getLogger(IotAgent.class);

    private final DeviceRegistry registry;
    private final LongAdder measures = new LongAdder();
    private final LongAdder refused = new LongAdder();
    private final Set<String> warned = ConcurrentHashMap.newKeySet();
    private volatile ContextBroker broker;
    private volatile URI provider = URI.create("http://127.0.0.1");
    private volatile Downlink downlink = (apikey, deviceId, command) -> false;

    IotAgent(DeviceRegistry registry) {
        this.registry = registry;
    }

    /** Each needs the other, so the second is given when both exist. */
    void connect(ContextBroker contextBroker) {
        broker = contextBroker;
    }

    /** @param base of the agent, under which the context broker shall know it */
    void connect(URI base) {
        provider = base;
    }

    void connect(Downlink toDevices) {
        downlink = toDevices;
    }

    long measures() {
        return measures.sum();
    }

    long refused() {
        return refused.sum();
    }

    /** Whether the device has an entity: it gets one with its first measure. */
    boolean hasEntity(Device device) {
        FiwareScope scope = device.scope();
        return !broker.tenant(scope.service())
                .find(scope.servicePath(), device.entityId(), Optional.of(device.entityType()))
                .isEmpty();
    }

    /** One message of a device: an object, or an array of objects that are one measure each. */
    void measured(String apikey, String deviceId, byte[] payload) {
        received("measure", apikey, deviceId, payload, (device, json) -> {
            for (JsonNode measure :
                    json.isArray() ? json : JsonNodeFactory.instance.arrayNode().add(json)) {
                if (!(measure instanceof ObjectNode object)) {
                    throw NgsiError.badRequest("a measure is a JSON object or an array of them");
                }
                String now = NgsiTime.format(broker.now());
                update(device, device.mapping().attributes(object, now));
            }
            measures.increment();
        });
    }

    /** The answer of a device to a command: {@code {"<command>": result}}. */
    void executed(String apikey, String deviceId, byte[] payload) {
        received("command result", apikey, deviceId, payload, (device, json) -> {
            for (Map.Entry<String, JsonNode> result : json.properties()) {
                if (device.mapping().commands().contains(result.getKey())) {
                    update(device, DeviceMapping.commandState(result.getKey(), "OK", result.getValue()));
                }
            }
        });
    }

    @Override
    public Optional<Registration> registration(FiwareScope scope, String entityId, Optional<String> type) {
        return registry.ofEntity(scope, entityId)
                .flatMap(this::registration)
                .filter(registration -> registration.covers(entityId, type));
    }

    @Override
    public List<Registration> registrations(String service, PathFilter paths) {
        return registry.devices(service, paths).stream()
                .flatMap(device -> registration(device).stream())
                .toList();
    }

    private Optional<Registration> registration(Device device) {
        Set<String> names = device.mapping().commands();
        return names.isEmpty()
                ? Optional.empty()
                : Optional.of(
                        new Registration(device.scope(), device.entityId(), device.entityType(), names, provider));
    }

    @Override
    public void issue(FiwareScope scope, String entityId, Map<String, JsonNode> commands) throws NgsiError {
        Device device = registry.ofEntity(scope, entityId).orElseThrow(NgsiError::noEntity);
        for (Map.Entry<String, JsonNode> command : commands.entrySet()) {
            // Before the message goes out: the device may answer faster than this thread goes on.
            Map<String, AttributeInput> pending = new LinkedHashMap<>(
                    DeviceMapping.commandState(command.getKey(), "PENDING", JsonNodeFactory.instance.nullNode()));
            pending.remove(command.getKey() + "_info");
            update(device, pending);
            ObjectNode message = JsonNodeFactory.instance.objectNode();
            message.set(command.getKey(), command.getValue());
            if (!downlink.send(device.apikey(), device.id(), NgsiJson.write(message))) {
                JsonNode reason = JsonNodeFactory.instance.textNode("the device cannot be reached: no MQTT connection");
                update(device, DeviceMapping.commandState(command.getKey(), "ERROR", reason));
            }
        }
    }

    /** Refuses as a whole what the context broker would refuse. */
    private void update(Device device, Map<String, AttributeInput> attributes) throws NgsiError {
        for (AttributeInput attribute : attributes.values()) {
            SyntaxRules.check(attribute);
        }
        broker.upsert(device.scope(), device.update(attributes), Options.NONE, Correlator.fresh());
    }

    private interface Reaction {
        void to(Device device, JsonNode json) throws NgsiError;
    }

    private void received(String what, String apikey, String deviceId, byte[] payload, Reaction reaction) {
        try {
            Optional<Device> device = registry.behind(apikey, deviceId);
            if (device.isEmpty()) {
                refuse(
                        "unknown API key " + apikey,
                        "%s of device %s: there is no device with this id and API key %s, or no service group with this key and resource %s"
                                .formatted(what, deviceId, apikey, DeviceRegistry.RESOURCE));
                return;
            }
            reaction.to(device.get(), NgsiJson.read(payload));
        } catch (UnreadableException | NgsiError e) {
            refuse(apikey + "/" + deviceId, what + " of device " + deviceId + ": " + e.getMessage());
        }
    }

    /** Counts each, tells of the first for the same cause only: a device that never stops would fill the log. */
    private void refuse(String cause, String message) {
        refused.increment();
        if (warned.size() < 1000 && warned.add(cause)) {
            LOG.warn("Ignored a {}. Further ones are only counted.", message);
        }
    }
}
