package io.furrow.model.ngsi;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.HashMap;
import java.util.Map;
import java.util.function.Predicate;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An entity, and each attribute as the JSON that it was read from, so that who writes it again need not compose it.
 *
 * @param attributes JSON by name; composed where the reported one is not normalized
 */
public record SlicedEntity(Entity entity, Map<String, String> attributes) {
    private static final Predicate<String> ANY = name -> true;

    /**
     * Reads the UTF-8 JSON of a normalized entity.
     *
     * @throws UnreadableException as {@link Entity#parse(byte[])}
     */
    public static SlicedEntity parse(byte[] normalized) throws UnreadableException {
        Map<String, String> slices = new HashMap<>();
        Entity entity =
                EntityExcerpt.read(normalized, ANY, (name, parser) -> readAndSlice(name, parser, normalized, slices));
        for (Map.Entry<String, JsonNode> attribute : entity.attributes()) {
            slices.computeIfAbsent(attribute.getKey(), any -> text(NgsiJson.write(attribute.getValue())));
        }
        return new SlicedEntity(entity, slices);
    }

    private static JsonNode readAndSlice(String name, JsonParser parser, byte[] bytes, Map<String, String> slices)
            throws IOException {
        int from = (int) parser.currentTokenLocation().getByteOffset();
        JsonNode value = EntityExcerpt.VALUES.readTree(parser);
        int to = (int) parser.currentLocation().getByteOffset();
        if (value instanceof ObjectNode attribute && EntityForm.isNormal(attribute)) {
            slices.put(name, new String(bytes, from, to - from, StandardCharsets.UTF_8));
        }
        return value;
    }

    private static String text(byte[] json) {
        return new String(json, StandardCharsets.UTF_8);
    }
}
