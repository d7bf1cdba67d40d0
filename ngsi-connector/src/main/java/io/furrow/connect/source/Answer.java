package io.furrow.connect.source;

import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletionException;
import java.util.concurrent.TimeoutException;

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
    private static final Map<String, String> SOON = Map.of("Retry-After", "1");

    static Answer taken(Optional<Refusal> refusal) {
        return refusal.map(why -> error(
                        why.reason() == Reason.TOO_LARGE ? 413 : 400,
                        why.reason().code(),
                        why.message(),
                        Map.of()))
                .orElseGet(() -> new Answer(200, new byte[0], Map.of()));
    }

    static Answer full() {
        return error(503, "unavailable", "the journal is full or the disk slow; nothing was taken", SOON);
    }

    static Answer notAllowed() {
        Map<String, String> allow = Map.of("Allow", "POST");
        return error(405, "method-not-allowed", "notifications come by POST; GET only knows /health", allow);
    }

    /** The answer to a request whose records did not become durable as far as known; empty for any other failure. */
    static Optional<Answer> notDurable(Throwable failure) {
        Throwable cause = failure instanceof CompletionException ? failure.getCause() : failure;
        if (cause instanceof TimeoutException) {
            return Optional.of(error(503, "unconfirmed", "the disk has not taken it yet; it may still", SOON));
        }
        if (cause instanceof Intake.NoRoomException) {
            return Optional.of(full());
        }
        return cause instanceof Intake.ClosedException
                ? Optional.of(error(503, "unavailable", cause.getMessage(), SOON))
                : Optional.empty();
    }

    private static Answer error(int status, String code, String description, Map<String, String> headers) {
        byte[] body = NgsiJson.write(
                JsonNodeFactory.instance.objectNode().put("error", code).put("description", description));
        return new Answer(status, body, headers);
    }
}
