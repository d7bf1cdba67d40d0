package io.furrow.model.ngsi;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.time.Duration;
import java.time.Instant;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.ObjectMapper;
import com.fasterxml.jackson.databind.module.SimpleModule;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.ser.std.ToStringSerializer;

/**
 * Converts records to JSON, with times and durations in ISO 8601. Nulls are omitted; members of later versions are
 * ignored, so that a downgrade is possible.
 */
public final class StateJson {
    private static final ObjectMapper MAPPER = NgsiJson.mapper()
            .copy()
            .setDefaultPropertyInclusion(JsonInclude.Include.NON_NULL)
            .disable(DeserializationFeature.FAIL_ON_UNKNOWN_PROPERTIES)
            .registerModule(new SimpleModule()
                    .addSerializer(Instant.class, ToStringSerializer.instance)
                    .addSerializer(Duration.class, ToStringSerializer.instance));

    private StateJson() {}

    public static byte[] write(Object state) {
        try {
            return MAPPER.writeValueAsBytes(state);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot be written as JSON: " + state.getClass(), e);
        }
    }

    /** Returns the members of a record. */
    public static ObjectNode tree(Object record) {
        return MAPPER.valueToTree(record);
    }

    /** Reads the value of a record of another process. */
    public static <T> T readRecord(byte[] value, Class<T> type) throws UnreadableException {
        try {
            return MAPPER.readValue(value, type);
        } catch (IOException e) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, JsonProblem.of(e), e);
        }
    }

    public static <T> T read(byte[] json, Class<T> type) {
        try {
            return MAPPER.readValue(json, type);
        } catch (IOException e) {
            throw new UncheckedIOException("the state is not a " + type.getSimpleName(), e);
        }
    }
}
