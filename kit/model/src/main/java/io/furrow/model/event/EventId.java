package io.furrow.model.event;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.Comparator;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.text.Sha256;
import io.furrow.model.time.Instants;

/**
 * Computes the id of an event: the first 128 bits of a SHA-256 over tenant, service path, entity type and id, event
 * time, the sorted attribute name and value pairs and, if present, the entity's {@code dateModified}, in lower-case
 * hexadecimal. Three changes that turn something on, off and on again at one device time are therefore three events.
 * Attribute types, metadata, other built-ins, the order of attributes and the notation of a number (18, 18.0, 1.8e1)
 * are ignored, because they differ between notifications of one change.
 */
public final class EventId {
    private static final int BYTES = 16;
    private static final int TYPICAL_LENGTH = 1024;

    private EventId() {}

    public static String of(FiwareScope scope, Entity entity, Instant eventTime) {
        List<Map.Entry<String, JsonNode>> attributes = entity.attributes();
        attributes.sort(Map.Entry.comparingByKey());
        Parts parts = new Parts();
        parts.addEvent(scope, entity.type(), entity.id(), eventTime);
        for (Map.Entry<String, JsonNode> attribute : attributes) {
            parts.addAttribute(attribute.getKey(), attribute.getValue().path("value"));
        }
        entity.value(Entity.MODIFIED).flatMap(Instants::of).ifPresent(parts::addModified);
        return parts.digest();
    }

    /** Returns the id of the event that reports the entity in this state. */
    public static String of(FiwareScope scope, EntityBuilder entity, Instant eventTime) {
        List<EntityBuilder.Attribute> attributes = entity.attributes();
        attributes.sort(Comparator.comparing(EntityBuilder.Attribute::name));
        Parts parts = new Parts();
        parts.addEvent(scope, entity.type(), entity.id(), eventTime);
        for (EntityBuilder.Attribute attribute : attributes) {
            parts.addAttribute(attribute.name(), attribute.value());
            if (attribute.name().equals(Entity.MODIFIED)) {
                Instants.of(attribute.value()).ifPresent(parts::addModified);
            }
        }
        return parts.digest();
    }

    /**
     * Returns the id of a deletion, which differs from those of all changes of the entity at the same time.
     *
     * @param type empty if unknown
     */
    static String ofDeletion(FiwareScope scope, String type, String entityId, Instant eventTime) {
        Parts parts = new Parts();
        parts.addEvent(scope, type, entityId, eventTime);
        parts.add("deleted");
        return parts.digest();
    }

    /**
     * Returns the id of a replayed event, which differs from the original's and between epochs.
     *
     * @param original id of the stored event
     * @param replay {@code <mission>.<id8>}
     */
    public static String ofReplay(String original, String replay, long epoch) {
        Parts parts = new Parts();
        parts.addText(original);
        parts.addText(replay);
        parts.add(Long.toString(epoch));
        return parts.digest();
    }

    /** Collects the input of the digest, because one large update is much cheaper than many small ones. */
    private static final class Parts {
        private final StringBuilder text = new StringBuilder(TYPICAL_LENGTH);
        private String modified = "";

        void addEvent(FiwareScope scope, String type, String entityId, Instant eventTime) {
            addText(scope.service());
            addText(scope.servicePath());
            addText(type);
            addText(entityId);
            text.append(eventTime.toEpochMilli());
        }

        /** Stores the time of modification, which is written last, because attributes are added in order. */
        void addModified(Instant time) {
            modified = "m" + time.toEpochMilli();
        }

        void addAttribute(String name, JsonNode value) {
            if (!Entity.BUILT_INS.contains(name)) {
                addText(name);
                addValue(value);
            }
        }

        /** Adds a text after its length, which makes the encoding injective without a separator. */
        void addText(String part) {
            text.append('"').append(part.length()).append(':').append(part);
        }

        void add(String part) {
            text.append(part);
        }

        void addValue(JsonNode value) {
            switch (value.getNodeType()) {
                case OBJECT -> {
                    TreeMap<String, JsonNode> members = new TreeMap<>();
                    value.properties().forEach(member -> members.put(member.getKey(), member.getValue()));
                    text.append('{').append(members.size());
                    members.forEach((name, member) -> {
                        addText(name);
                        addValue(member);
                    });
                }
                case ARRAY -> {
                    text.append('[').append(value.size());
                    value.forEach(this::addValue);
                }
                case STRING -> addText(value.textValue());
                case NUMBER -> text.append('#').append(CanonicalNumber.of(value));
                default -> text.append(value.asText("null"));
            }
        }

        String digest() {
            byte[] digest = Sha256.of(text.append(modified).toString().getBytes(StandardCharsets.UTF_8));
            return HexFormat.of().formatHex(digest, 0, BYTES);
        }
    }
}
