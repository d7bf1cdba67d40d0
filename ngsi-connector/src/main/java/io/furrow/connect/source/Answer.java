package io.furrow.connect.source;

import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.connect.source.Translation.Refusal;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;

/**
 * An HTTP answer: no body where all is well, else {@code {"error": code, "description": sentence}}.
 *
 * @param headers besides the content type
 */
record Answer(int status, byte[] body, Map<String, String> headers) {
    private static final Answer OK = new Answer(200, new byte[0], Map.of());

    static Answer taken(Optional<Refusal> refusal) {
        return refusal.map(why -> error(
                        why.reason() == Reason.TOO_LARGE ? 413 : 400,
                        why.reason().code(),
                        why.message(),
                        Map.of()))
                .orElse(OK);
    }

    /** For a sender that tries again; what did not become durable in time. */
    static Answer overload() {
        return error(503, "unavailable", "the notification is not durable; send it again", Map.of("Retry-After", "1"));
    }

    static Answer unauthorized() {
        return error(401, "unauthorized", "the notification was not taken", Map.of());
    }

    static Answer foreignTenant() {
        return error(403, "forbidden", "notifications of this tenant are not taken", Map.of());
    }

    static Answer notAllowed() {
        Map<String, String> allow = Map.of("Allow", "POST");
        return error(405, "method-not-allowed", "notifications come by POST; GET knows /health and /metrics", allow);
    }

    private static Answer error(int status, String code, String description, Map<String, String> headers) {
        return new Answer(status, error(code, description), headers);
    }

    static byte[] error(String code, String description) {
        return NgsiJson.write(
                JsonNodeFactory.instance.objectNode().put("error", code).put("description", description));
    }
}
