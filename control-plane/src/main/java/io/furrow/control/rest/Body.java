package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Bodies of requests: one JSON object, as strictly read as everything else. */
final class Body {
    private static final int MOST_BYTES = 8 * 1024 * 1024;

    private Body() {}

    /** An empty body is an empty object. @throws ProblemException where it is no object, or too large */
    static ObjectNode read(InputStream body) throws IOException {
        byte[] bytes = body.readNBytes(MOST_BYTES + 1);
        if (bytes.length > MOST_BYTES) {
            throw new ProblemException(413, "too-large", "the body has more than " + MOST_BYTES + " bytes");
        }
        if (bytes.length == 0) {
            return JsonNodeFactory.instance.objectNode();
        }
        try {
            JsonNode json = NgsiJson.read(bytes);
            if (json instanceof ObjectNode object) {
                return object;
            }
        } catch (UnreadableException e) {
            throw new ProblemException(ErrorCode.NOT_JSON, e.getMessage());
        }
        throw new ProblemException(ErrorCode.NOT_A_REQUEST, "the body is no JSON object");
    }
}
