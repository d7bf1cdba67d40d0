package io.furrow.control.rest;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.time.Duration;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Bodies of requests: one JSON object, as strictly read as everything else. */
final class Body {
    /** Who sends more sees his connection end. */
    private static final long MAX_READ = 64L * 1024 * 1024;

    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final int BUFFER_BYTES = 8192;

    private Body() {}

    /** An empty body is an empty object. @throws ProblemException where it is no object, or too large */
    static ObjectNode read(InputStream body) throws IOException {
        byte[] bytes = bytes(body, Limits.REQUEST_BYTES);
        if (bytes.length == 0) {
            return JsonNodeFactory.instance.objectNode();
        }
        try {
            JsonNode json = NgsiJson.read(bytes);
            if (json instanceof ObjectNode object) {
                return object;
            }
        } catch (UnreadableException e) {
            throw new ProblemException(ErrorCode.NOT_JSON, "the body is not JSON: " + e.getMessage());
        }
        throw new ProblemException(ErrorCode.NOT_A_REQUEST, "the body is no JSON object");
    }

    /** At most so many. What is too large is read too, or many a client would see no answer. */
    static byte[] bytes(InputStream body, int most) throws IOException {
        ByteArrayOutputStream kept = new ByteArrayOutputStream();
        if (read(body, most, kept) > most) {
            throw ProblemException.tooLarge(-1, most);
        }
        return kept.toByteArray();
    }

    /** Reads what is left and forgets it. */
    static void drain(InputStream body) throws IOException {
        read(body, 0, new ByteArrayOutputStream(0));
    }

    /** In time, because whoever sends slowly occupies a thread. */
    private static long read(InputStream body, int most, ByteArrayOutputStream kept) throws IOException {
        long end = System.nanoTime() + TIMEOUT.toNanos();
        byte[] buffer = new byte[BUFFER_BYTES];
        long total = 0;
        for (int count = body.read(buffer); count >= 0 && total <= MAX_READ; count = body.read(buffer)) {
            total += count;
            if (total <= most) {
                kept.write(buffer, 0, count);
            }
            if (System.nanoTime() - end > 0) {
                throw new ProblemException(
                        408, "request-timeout", "the body did not come within %d s".formatted(TIMEOUT.toSeconds()));
            }
        }
        return total;
    }
}
