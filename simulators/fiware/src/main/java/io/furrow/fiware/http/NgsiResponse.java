package io.furrow.fiware.http;

import java.nio.charset.StandardCharsets;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;

/** An HTTP response; without a body it has no media type. */
public record NgsiResponse(int status, String mediaType, byte[] body, Map<String, String> headers) {
    private static final byte[] NOTHING = {};

    public static NgsiResponse json(int status, JsonNode body) {
        return new NgsiResponse(status, "application/json", NgsiJson.write(body), Map.of());
    }

    public static NgsiResponse ok(JsonNode body) {
        return json(200, body);
    }

    /**
     * A page of a list.
     *
     * @param total number of elements on all pages, sent with {@code options=count}
     */
    public static NgsiResponse page(NgsiRequest call, JsonNode body, int total) {
        NgsiResponse page = ok(body);
        return call.option("count") ? page.with("Fiware-Total-Count", Integer.toString(total)) : page;
    }

    public static NgsiResponse created(String location) {
        return new NgsiResponse(201, "", NOTHING, Map.of("Location", location));
    }

    public static NgsiResponse noContent() {
        return new NgsiResponse(204, "", NOTHING, Map.of());
    }

    public static NgsiResponse html(int status, String text) {
        return new NgsiResponse(status, "text/html; charset=utf-8", text.getBytes(StandardCharsets.UTF_8), Map.of());
    }

    public NgsiResponse with(String header, String value) {
        return new NgsiResponse(status, mediaType, body, Map.of(header, value));
    }
}
