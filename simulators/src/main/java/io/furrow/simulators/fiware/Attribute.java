package io.furrow.simulators.fiware;

import java.time.Instant;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An attribute as it is stored; never changed, only replaced, so that notifications can be written later and elsewhere.
 *
 * @param metadata {@code {<name>: {type, value}}} in the order given
 * @param modified of the last request that changed it
 */
record Attribute(String type, JsonNode value, ObjectNode metadata, Instant created, Instant modified) {
    boolean sameAs(Attribute other) {
        return type.equals(other.type) && value.equals(other.value) && metadata.equals(other.metadata);
    }
}
