package io.furrow.fiware.broker;

import java.time.Instant;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An immutable stored attribute, so that notifications can be written later by other threads.
 *
 * @param metadata {@code {<name>: {type, value}}} in the given order
 * @param modified time of the last request that changed it
 */
public record StoredAttribute(String type, JsonNode value, ObjectNode metadata, Instant created, Instant modified) {
    boolean sameAs(StoredAttribute other) {
        return type.equals(other.type) && value.equals(other.value) && metadata.equals(other.metadata);
    }
}
