package io.furrow.fiware.http;

import java.nio.charset.StandardCharsets;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;

/** An HTTP response; without a body it has no media type. */
public record Reply(int status, String mediaType, byte[] body, Map<String, String> headers) {
    private static final byte[] NOTHING = {};

    public static Reply json(int status, JsonNode body) {
        return new Reply(status, "application/json", NgsiJson.write(body), Map.of());
    }

    public static Reply ok(JsonNode body) {
        return json(200, body);
    }

    /**
     * A page of a list.
     *
     * @param total number of elements on all pages, sent with {@code options=count}
     */
    public static Reply page(Call call, JsonNode body, int total) {
        Reply page = ok(body);
        return call.option("count") ? page.with("Fiware-Total-Count", Integer.toString(total)) : page;
    }

    public static Reply created(String location) {
        return new Reply(201, "", NOTHING, Map.of("Location", location));
    }

    public static Reply noContent() {
        return new Reply(204, "", NOTHING, Map.of());
    }

    public static Reply html(int status, String text) {
        return new Reply(status, "text/html; charset=utf-8", text.getBytes(StandardCharsets.UTF_8), Map.of());
    }

    public Reply with(String header, String value) {
        return new Reply(status, mediaType, body, Map.of(header, value));
    }
}
