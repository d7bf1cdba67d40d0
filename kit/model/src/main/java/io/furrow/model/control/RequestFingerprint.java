package io.furrow.model.control;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.util.HexFormat;

import com.fasterxml.jackson.databind.ObjectMapper;
import com.fasterxml.jackson.databind.cfg.JsonNodeFeature;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.Sha256;

/**
 * Computes a fingerprint to compare two requests of one id: 32 hexadecimal digits of the SHA-256 of all members except
 * {@code requestId}, in any order. The user is a member, so the same id from another user is another request.
 */
public final class RequestFingerprint {
    /** Header of a response with the fingerprint of its request. */
    public static final String HEADER = "request-fingerprint";

    private static final int BYTES = 16;
    private static final ObjectMapper SORTED =
            NgsiJson.mapper().copy().configure(JsonNodeFeature.WRITE_PROPERTIES_SORTED, true);

    private RequestFingerprint() {}

    /** Returns the fingerprint of a record's value; empty if it is not a JSON object. */
    public static String of(byte[] request) {
        try {
            return NgsiJson.read(request) instanceof ObjectNode object ? of(object) : "";
        } catch (UnreadableException e) {
            return ""; // such a request has no id
        }
    }

    public static String of(ObjectNode request) {
        try {
            String members = SORTED.writeValueAsString(request.deepCopy().without("requestId"));
            // UTF-16, because a text may contain half of a surrogate pair: such a request is rejected, but has an id.
            return HexFormat.of().formatHex(Sha256.of(members.getBytes(StandardCharsets.UTF_16BE)), 0, BYTES);
        } catch (IOException e) {
            throw new UncheckedIOException("a request could not be written as JSON", e);
        }
    }
}
