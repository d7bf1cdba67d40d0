package io.furrow.connect.source.http;

import java.nio.ByteBuffer;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.connect.source.notification.Translation.Refusal;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;

/**
 * An HTTP answer: an empty body for success, else {@code {"error": code, "description": sentence}}.
 *
 * @param headers besides the content type
 */
public record NotificationResponse(int status, byte[] body, Map<String, String> headers) {
    private static final NotificationResponse OK = new NotificationResponse(200, new byte[0], Map.of());

    public static NotificationResponse taken(Optional<Refusal> refusal) {
        return refusal.map(why -> error(
                        why.reason() == Reason.TOO_LARGE ? 413 : 400,
                        why.reason().code(),
                        why.message(),
                        Map.of()))
                .orElse(OK);
    }

    /** For a sender that retries: the notification did not become durable in time. */
    static NotificationResponse overload() {
        return error(503, "unavailable", "the notification is not durable; send it again", Map.of("Retry-After", "1"));
    }

    static NotificationResponse unauthorized() {
        return error(401, "unauthorized", "the notification was rejected: the secret is missing or wrong", Map.of());
    }

    static NotificationResponse foreignTenant() {
        return error(403, "forbidden", "notifications of this tenant are not accepted", Map.of());
    }

    static NotificationResponse notAllowed() {
        Map<String, String> allow = Map.of("Allow", "GET, HEAD, POST");
        return error(405, "method-not-allowed", "send notifications with POST; GET and HEAD: /health, /metrics", allow);
    }

    static NotificationResponse unknownEncoding() {
        return error(
                415,
                "unsupported-encoding",
                "the body was not read; send it without Content-Encoding, or with gzip alone",
                Map.of("Accept-Encoding", "gzip"));
    }

    /** The rest of the body is dropped: it cannot be decoded. */
    static NotificationResponse notGzip(String why) {
        return error(400, "not-gzip", "Content-Encoding says gzip, but the body is not gzip: " + why, Map.of());
    }

    void write(Response response, Callback callback) {
        response.setStatus(status);
        headers.forEach((name, value) -> response.getHeaders().put(name, value));
        if (body.length > 0) {
            response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
        }
        response.write(true, ByteBuffer.wrap(body), callback);
    }

    private static NotificationResponse error(
            int status, String code, String description, Map<String, String> headers) {
        return new NotificationResponse(status, error(code, description), headers);
    }

    static byte[] error(String code, String description) {
        return NgsiJson.write(
                JsonNodeFactory.instance.objectNode().put("error", code).put("description", description));
    }
}
