package io.furrow.soak.devices;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Parses text that must be JSON. */
final class JsonReader {
    private JsonReader() {}

    static JsonNode read(String text) {
        try {
            return NgsiJson.read(text.getBytes(UTF_8));
        } catch (UnreadableException e) {
            throw new IllegalStateException("no JSON: " + text, e);
        }
    }
}
