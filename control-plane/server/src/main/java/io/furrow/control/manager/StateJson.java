package io.furrow.control.manager;

import java.io.IOException;
import java.io.UncheckedIOException;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.ObjectMapper;

import io.furrow.model.ngsi.JsonProblem;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** Records of plain members as JSON; members that a later version has are skipped, so that one can go back. */
public final class StateJson {
    private static final ObjectMapper MAPPER = NgsiJson.mapper()
            .copy()
            .setDefaultPropertyInclusion(JsonInclude.Include.NON_NULL)
            .disable(DeserializationFeature.FAIL_ON_UNKNOWN_PROPERTIES);

    private StateJson() {}

    public static byte[] write(Object state) {
        try {
            return MAPPER.writeValueAsBytes(state);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot be written as JSON: " + state.getClass(), e);
        }
    }

    /** Reads the value of a record that another process wrote. */
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
            throw new UncheckedIOException("the state is no " + type.getSimpleName(), e);
        }
    }
}
