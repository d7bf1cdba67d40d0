package io.furrow.fiware.broker;

import java.time.Instant;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.Entity;

/**
 * Renders entities for queries and notifications.
 *
 * @param attrs empty for all own attributes; else these in this order, built-ins among them, {@code *} for the own ones
 * @param metadata empty for all own metadata; else these, built-ins among them, {@code *} for the own ones
 */
public record Rendering(List<String> attrs, List<String> metadata, Format format) {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final String ALL = "*";

    /** The formats of an entity, named as in {@code attrsFormat} and {@code Ngsiv2-AttrsFormat}. */
    public enum Format {
        NORMALIZED("normalized"),
        KEY_VALUES("keyValues"),
        VALUES("values"),
        SIMPLIFIED_NORMALIZED("simplifiedNormalized"),
        SIMPLIFIED_KEY_VALUES("simplifiedKeyValues");

        private final String label;

        Format(String label) {
            this.label = label;
        }

        public String label() {
            return label;
        }

        /** Whether a notification carries the bare entity instead of {@code {subscriptionId, data}}. */
        public boolean isBare() {
            return this == SIMPLIFIED_NORMALIZED || this == SIMPLIFIED_KEY_VALUES;
        }
    }

    /** Renders an entity for a query: own attributes in the order of their names. */
    public JsonNode of(StoredEntity entity) {
        return write(entity, new ArrayList<>(new TreeSet<>(entity.attributes().keySet())), Optional.empty());
    }

    /** Renders an entity for a notification of the change. */
    JsonNode of(EntityChange change, boolean onlyChanged) {
        List<String> own = new ArrayList<>(change.after().attributes().keySet());
        if (onlyChanged) {
            own.retainAll(change.changed());
        }
        return write(change.after(), own, Optional.of(change));
    }

    private JsonNode write(StoredEntity entity, List<String> own, Optional<EntityChange> change) {
        Map<String, JsonNode> written = new LinkedHashMap<>();
        for (String name : selected(own)) {
            if (Entity.BUILT_INS.contains(name)) {
                builtIn(name, entity, change).ifPresent(value -> written.put(name, value));
            } else {
                written.put(name, attribute(name, entity.attributes().get(name), change));
            }
        }
        if (format == Format.VALUES) {
            return NODES.arrayNode().addAll(written.values());
        }
        ObjectNode json = NODES.objectNode().put("id", entity.id()).put("type", entity.type());
        written.forEach(json::set);
        return json;
    }

    private Set<String> selected(List<String> own) {
        Set<String> all = new LinkedHashSet<>(own);
        if (attrs.isEmpty()) {
            return all;
        }
        Set<String> selected = new LinkedHashSet<>();
        for (String name : attrs) {
            if (name.equals(ALL)) {
                selected.addAll(all);
            } else if (all.contains(name) || Entity.BUILT_INS.contains(name)) {
                selected.add(name);
            }
        }
        return selected;
    }

    private JsonNode attribute(String name, StoredAttribute attribute, Optional<EntityChange> change) {
        return isNormalized()
                ? triple(attribute.type(), attribute.value(), metadata(name, attribute, change))
                : attribute.value();
    }

    private Optional<JsonNode> builtIn(String name, StoredEntity entity, Optional<EntityChange> change) {
        return switch (name) {
            case "dateCreated" -> Optional.of(builtIn("DateTime", NgsiTime.format(entity.created())));
            case "dateModified" -> Optional.of(builtIn("DateTime", NgsiTime.format(entity.modified())));
            case "servicePath" -> Optional.of(builtIn("Text", entity.scope().servicePath()));
            case "alterationType" ->
                change.map(some -> builtIn("Text", some.kind().alteration()));
            default -> Optional.empty();
        };
    }

    private JsonNode builtIn(String type, String value) {
        JsonNode text = NODES.textNode(value);
        return isNormalized() ? triple(type, text, NODES.objectNode()) : text;
    }

    /** Own metadata first, then the built-in ones in Orion's order. */
    private ObjectNode metadata(String name, StoredAttribute attribute, Optional<EntityChange> change) {
        if (metadata.isEmpty()) {
            return attribute.metadata();
        }
        ObjectNode selected = NODES.objectNode();
        for (Map.Entry<String, JsonNode> entry : attribute.metadata().properties()) {
            if (metadata.contains(ALL) || metadata.contains(entry.getKey())) {
                selected.set(entry.getKey(), entry.getValue());
            }
        }
        date(selected, "dateCreated", attribute.created());
        date(selected, "dateModified", attribute.modified());
        if (change.isPresent()) {
            change(selected, name, change.get());
        }
        return selected;
    }

    private void date(ObjectNode selected, String name, Instant time) {
        if (metadata.contains(name)) {
            selected.set(name, pair("DateTime", NODES.textNode(NgsiTime.format(time))));
        }
    }

    private void change(ObjectNode selected, String name, EntityChange change) {
        String action = change.actions().get(name);
        if (metadata.contains("actionType") && action != null) {
            selected.set("actionType", pair("Text", NODES.textNode(action)));
        }
        if (metadata.contains("previousValue") && action != null) {
            change.before()
                    .map(before -> before.attributes().get(name))
                    .ifPresent(old -> selected.set("previousValue", pair(old.type(), old.value())));
        }
    }

    private boolean isNormalized() {
        return format == Format.NORMALIZED || format == Format.SIMPLIFIED_NORMALIZED;
    }

    private static ObjectNode triple(String type, JsonNode value, ObjectNode metadata) {
        ObjectNode triple = pair(type, value);
        triple.set("metadata", metadata);
        return triple;
    }

    private static ObjectNode pair(String type, JsonNode value) {
        ObjectNode pair = NODES.objectNode().put("type", type);
        pair.set("value", value);
        return pair;
    }
}
