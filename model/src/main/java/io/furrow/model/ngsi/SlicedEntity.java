package io.furrow.model.ngsi;

import java.nio.charset.StandardCharsets;
import java.util.HashMap;
import java.util.Map;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.core.StreamReadFeature;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectReader;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An entity, and each attribute as the JSON that it was read from, so that who writes it again need not compose it.
 *
 * @param attributes JSON by name; composed where the reported one is not normalized
 */
public record SlicedEntity(Entity entity, Map<String, String> attributes) {
    /** Reads a value where it stands: what follows it belongs to the entity. */
    private static final ObjectReader CHECKED = NgsiJson.mapper()
            .reader()
            .without(DeserializationFeature.FAIL_ON_TRAILING_TOKENS)
            .without(StreamReadFeature.STRICT_DUPLICATE_DETECTION);

    /**
     * Reads the UTF-8 JSON of a normalized entity.
     *
     * @throws UnreadableException as {@link Entity#parse(byte[])}
     */
    public static SlicedEntity parse(byte[] normalized) throws UnreadableException {
        Entity.parse(normalized);
        return ofChecked(normalized);
    }

    /**
     * Reads what was read as an entity before: quicker, since it does not look for repeated names and wrong bytes again.
     *
     * @param normalized which {@link Entity#parse} takes, with whichever attributes
     * @throws UnreadableException as that, but for those
     */
    public static SlicedEntity ofChecked(byte[] normalized) throws UnreadableException {
        return NgsiJson.understand(() -> {
            ObjectNode entity = JsonNodeFactory.instance.objectNode();
            Map<String, String> slices = new HashMap<>();
            try (JsonParser parser = CHECKED.createParser(normalized)) {
                if (parser.nextToken() != JsonToken.START_OBJECT) {
                    throw new UnreadableException(Reason.NOT_AN_ENTITY, "an entity is a JSON object");
                }
                while (parser.nextToken() == JsonToken.FIELD_NAME) {
                    String name = parser.currentName();
                    parser.nextToken();
                    int from = (int) parser.currentTokenLocation().getByteOffset();
                    JsonNode reported = CHECKED.readTree(parser);
                    int to = (int) parser.currentLocation().getByteOffset();
                    if (reported.isTextual()) { // id or type
                        entity.set(name, reported);
                    } else {
                        ObjectNode attribute = EntityForm.NORMALIZED.attribute(name, reported);
                        entity.set(name, attribute);
                        slices.put(
                                name,
                                attribute == reported
                                        ? new String(normalized, from, to - from, StandardCharsets.UTF_8)
                                        : new String(NgsiJson.write(attribute), StandardCharsets.UTF_8));
                    }
                }
            }
            EntityLimits.check(entity);
            return new SlicedEntity(new Entity(entity), slices);
        });
    }
}
