package io.furrow.fiware.agent;

import java.util.ArrayList;
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

import io.furrow.fiware.broker.AttributeInput;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.NgsiTime;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.http.Correlator;
import io.furrow.fiware.http.NgsiError;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Connects devices with the context broker. Measures become updates of entities, the first one creates the entity;
 * updates of command attributes become messages to devices, with {@code <command>_status} {@code PENDING} until the
 * device answers, then {@code OK}.
 */
public final class IotAgent implements ContextBroker.Commands {
    /** Sends commands to devices. */
    interface Downlink {
        /** @return false if the message cannot be sent */
        boolean send(String apikey, String deviceId, byte[] command);
    }

    private static final Logger LOG = LoggerFactory.getLogger(IotAgent.class);

    private final DeviceRegistry registry;
    private final MeasureHistory history;
    private final LongAdder measures = new LongAdder();
    private final LongAdder refused = new LongAdder();
    private final Set<String> warned = ConcurrentHashMap.newKeySet();
    private volatile ContextBroker broker;
    private volatile Downlink downlink = (apikey, deviceId, command) -> false;

    public IotAgent(DeviceRegistry registry, MeasureHistory history) {
        this.registry = registry;
        this.history = history;
    }

    /** Set after construction, because each needs the other. */
    public void connect(ContextBroker contextBroker) {
        broker = contextBroker;
    }

    public void connect(Downlink toDevices) {
        downlink = toDevices;
    }

    public long measures() {
        return measures.sum();
    }

    public long refused() {
        return refused.sum();
    }

    /** Processes a message of a device: one measure, or an array of them, of which a wrong one harms no other. */
    void measured(String apikey, String deviceId, byte[] payload) {
        received("measure", apikey, deviceId, payload, (device, json) -> {
            JsonNode all =
                    json.isArray() ? json : JsonNodeFactory.instance.arrayNode().add(json);
            List<NgsiError> errors = new ArrayList<>();
            for (JsonNode measure : all) {
                try {
                    measured(device, measure);
                } catch (NgsiError e) {
                    errors.add(e);
                }
            }
            if (errors.isEmpty() || errors.size() < all.size()) {
                measures.increment();
                history.measured(apikey, deviceId);
            }
            if (!errors.isEmpty()) {
                throw errors.get(0);
            }
        });
    }

    private void measured(ProvisionedDevice device, JsonNode measure) throws NgsiError {
        if (!(measure instanceof ObjectNode object)) {
            throw NgsiError.badRequest("a measure is a JSON object or an array of them");
        }
        update(device, device.mapping().attributes(object, NgsiTime.format(broker.now())));
    }

    /** Processes the answer of a device to a command: {@code {"<command>": result}}. */
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
    public Set<String> of(FiwareScope scope, String entityId, Optional<String> type) {
        return registry.ofEntity(scope, entityId)
                .filter(device -> type.isEmpty() || type.get().equals(device.entityType()))
                .map(device -> device.mapping().commands())
                .orElse(Set.of());
    }

    @Override
    public void issue(FiwareScope scope, String entityId, Map<String, JsonNode> commands) throws NgsiError {
        ProvisionedDevice device = registry.ofEntity(scope, entityId).orElseThrow(NgsiError::noEntity);
        for (Map.Entry<String, JsonNode> command : commands.entrySet()) {
            // Before the message goes out: the device may answer faster than this thread continues.
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

    /** Refuses the whole update if the context broker would refuse an attribute. */
    private void update(ProvisionedDevice device, Map<String, AttributeInput> attributes) throws NgsiError {
        for (AttributeInput attribute : attributes.values()) {
            SyntaxRules.check(attribute);
        }
        broker.upsert(device.scope(), device.update(attributes), false, Correlator.fresh());
    }

    private interface Reaction {
        void to(ProvisionedDevice device, JsonNode json) throws NgsiError;
    }

    private void received(String what, String apikey, String deviceId, byte[] payload, Reaction reaction) {
        try {
            Optional<ProvisionedDevice> device = registry.behind(apikey, deviceId);
            if (device.isEmpty()) {
                String reason =
                        "there is no device with this id and API key %s, or no service group with this key and resource %s"
                                .formatted(apikey, DeviceRegistry.RESOURCE);
                history.unknown(apikey, deviceId, payload, reason);
                refuse("unknown API key " + apikey, "%s of device %s: %s".formatted(what, deviceId, reason));
                return;
            }
            reaction.to(device.get(), NgsiJson.read(payload));
        } catch (UnreadableException e) {
            unreadable(what, apikey, deviceId, payload, "not JSON: " + e.getMessage());
        } catch (NgsiError e) {
            unreadable(what, apikey, deviceId, payload, e.getMessage());
        }
    }

    private void unreadable(String what, String apikey, String deviceId, byte[] payload, String why) {
        history.unreadable(apikey, deviceId, payload, why);
        refuse(apikey + "/" + deviceId, what + " of device " + deviceId + ": " + why);
    }

    /** Counts each, logs the first of each cause only. */
    private void refuse(String cause, String message) {
        refused.increment();
        if (warned.size() < 1000 && warned.add(cause)) {
            LOG.warn("Ignored a {}. Further ones are only counted.", message);
        }
    }
}
