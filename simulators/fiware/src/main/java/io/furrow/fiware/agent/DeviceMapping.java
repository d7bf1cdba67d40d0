package io.furrow.fiware.agent;

import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.broker.AttributeInput;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.http.NgsiError;

/**
 * Maps measures of a device to attributes.
 *
 * @param active by {@code object_id}, or by name without one
 * @param fixed static attributes, added to every update
 * @param commands names
 * @param timestamped whether {@code TimeInstant} is added as attribute and as metadata of all others
 * @param explicit whether measures without a provisioned attribute are omitted
 */
record DeviceMapping(
        Map<String, Target> active,
        Map<String, AttributeInput> fixed,
        Set<String> commands,
        boolean timestamped,
        boolean explicit) {
    private static final String TIME_INSTANT = "TimeInstant";
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    /** The attribute of a measure; {@code metadata} is an object, or missing. */
    record Target(String name, String type, JsonNode metadata) {
        AttributeInput input(JsonNode value) {
            AttributeInput input = AttributeInput.of(type, value);
            for (Map.Entry<String, JsonNode> each : metadata.properties()) {
                input = input.withMetadata(each.getKey(), (ObjectNode) each.getValue());
            }
            return input;
        }
    }

    /** Reserved names are ignored, as in FIWARE's agents. */
    static DeviceMapping read(JsonNode json) throws NgsiError {
        Map<String, Target> active = new LinkedHashMap<>();
        for (JsonNode attribute : json.path("attributes")) {
            String name = text(attribute, "name");
            if (!SyntaxRules.isReserved(name)) {
                active.put(
                        attribute.path("object_id").asText(name),
                        new Target(name, attribute.path("type").asText("Text"), attribute.path("metadata")));
            }
        }
        Map<String, AttributeInput> fixed = new LinkedHashMap<>();
        for (JsonNode attribute : json.path("static_attributes")) {
            JsonNode value = attribute.has("value")
                    ? AttributeInput.canonical(attribute.get("value").deepCopy())
                    : NODES.nullNode();
            String type = attribute.path("type").asText(AttributeInput.defaultType(value));
            fixed.put(text(attribute, "name"), AttributeInput.of(type, value));
        }
        fixed.keySet().removeIf(SyntaxRules::isReserved);
        Set<String> commands = new LinkedHashSet<>();
        for (JsonNode command : json.path("commands")) {
            commands.add(text(command, "name"));
        }
        commands.removeIf(SyntaxRules::isReserved);
        boolean timestamped = json.path("timestamp").asBoolean(true);
        return new DeviceMapping(
                active, fixed, commands, timestamped, json.path("explicitAttrs").asBoolean(false));
    }

    /** Merges with the mapping of the group: the device's entries come first, its settings win. */
    DeviceMapping over(DeviceMapping group) {
        Map<String, Target> allActive = new LinkedHashMap<>(group.active);
        allActive.putAll(active);
        Map<String, AttributeInput> allFixed = new LinkedHashMap<>(group.fixed);
        allFixed.putAll(fixed);
        Set<String> allCommands = new LinkedHashSet<>(group.commands);
        allCommands.addAll(commands);
        return new DeviceMapping(
                allActive, allFixed, allCommands, timestamped && group.timestamped, explicit || group.explicit);
    }

    static Map<String, AttributeInput> commandState(String command, String status, JsonNode info) {
        Map<String, AttributeInput> state = new LinkedHashMap<>();
        state.put(command + "_status", AttributeInput.of("commandStatus", NODES.textNode(status)));
        state.put(command + "_info", AttributeInput.of("commandResult", info));
        return state;
    }

    /**
     * The update of one measure: measures, static attributes, {@code TimeInstant}, in this order. A measure named
     * {@code id} becomes {@code measure_id}, as in FIWARE's agents, and so do all names that an attribute cannot have.
     */
    Map<String, AttributeInput> attributes(ObjectNode measure, String receivedAt) throws NgsiError {
        Map<String, AttributeInput> attributes = new LinkedHashMap<>();
        for (Map.Entry<String, JsonNode> member : measure.properties()) {
            Target target = active.get(member.getKey());
            JsonNode value = AttributeInput.canonical(member.getValue());
            if (target != null) {
                attributes.put(target.name(), target.input(value));
            } else if (member.getKey().equals(TIME_INSTANT)) {
                attributes.put(TIME_INSTANT, AttributeInput.of("DateTime", value));
            } else if (!explicit) {
                String name = SyntaxRules.isReserved(member.getKey()) ? "measure_" + member.getKey() : member.getKey();
                SyntaxRules.checkAttributeName(name);
                attributes.put(name, AttributeInput.of(AttributeInput.defaultType(value), value));
            }
        }
        fixed.forEach(attributes::putIfAbsent);
        return timestamped ? stamped(attributes, receivedAt) : attributes;
    }

    private static Map<String, AttributeInput> stamped(Map<String, AttributeInput> attributes, String receivedAt) {
        AttributeInput own = attributes.get(TIME_INSTANT);
        JsonNode time = own == null ? NODES.textNode(receivedAt) : own.value();
        ObjectNode metadata = NODES.objectNode().put("type", "DateTime");
        metadata.set("value", time);
        Map<String, AttributeInput> stamped = new LinkedHashMap<>();
        for (Map.Entry<String, AttributeInput> entry : attributes.entrySet()) {
            stamped.put(entry.getKey(), entry.getValue().withMetadata(TIME_INSTANT, metadata));
        }
        stamped.put(TIME_INSTANT, AttributeInput.of("DateTime", time));
        return stamped;
    }

    private static String text(JsonNode json, String field) throws NgsiError {
        if (!json.path(field).isTextual()) {
            throw AgentErrors.wrongSyntax();
        }
        return json.get(field).textValue();
    }
}
