package io.furrow.model.ngsi;

import java.io.IOException;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectReader;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Reads the wanted attributes of a normalized entity in one pass; the others are passed over without becoming objects. */
final class EntityExcerpt {
    /** Reads a value where it stands: what follows it belongs to the entity. */
    private static final ObjectReader VALUES =
            NgsiJson.mapper().reader().without(DeserializationFeature.FAIL_ON_TRAILING_TOKENS);

    private EntityExcerpt() {}

    static Entity read(byte[] normalized, Set<String> wanted) throws UnreadableException {
        JsonNode excerpt = NgsiJson.understand(() -> {
            try (JsonParser parser = NgsiJson.mapper().createParser(normalized)) {
                return excerpt(parser, wanted);
            }
        });
        return EntityForm.NORMALIZED.read(excerpt);
    }

    private static ObjectNode excerpt(JsonParser parser, Set<String> wanted) throws IOException, UnreadableException {
        JsonToken first = parser.nextToken();
        if (first != JsonToken.START_OBJECT) {
            throw first == null
                    ? new UnreadableException(Reason.NOT_JSON, "the body is empty")
                    : new UnreadableException(Reason.NOT_AN_ENTITY, "an entity is a JSON object");
        }
        ObjectNode excerpt = JsonNodeFactory.instance.objectNode();
        while (parser.nextToken() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            JsonToken value = parser.nextToken();
            if (name.equals("id") || name.equals("type") || wanted.contains(name)) {
                excerpt.set(name, VALUES.readTree(parser));
            } else if (value == JsonToken.START_OBJECT) {
                parser.skipChildren();
            } else {
                throw new UnreadableException(
                        Reason.NOT_AN_ENTITY, "attribute '" + name + "' is no object with a member 'value'");
            }
        }
        if (parser.nextToken() != null) {
            throw new UnreadableException(Reason.NOT_JSON, "something follows the entity");
        }
        return excerpt;
    }
}
