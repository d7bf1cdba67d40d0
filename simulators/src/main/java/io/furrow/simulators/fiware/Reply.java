package io.furrow.simulators.fiware;

import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

/** An HTTP answer; without a body its length is 0. */
record Reply(int status, Optional<JsonNode> body, Map<String, String> headers) {
    static Reply ok(JsonNode body) {
        return new Reply(200, Optional.of(body), Map.of());
    }

    static Reply created(String location) {
        return new Reply(201, Optional.empty(), Map.of("Location", location));
    }

    static Reply noContent() {
        return new Reply(204, Optional.empty(), Map.of());
    }
}
