package io.furrow.control.rest;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.lang.reflect.Method;
import java.time.Duration;
import java.util.List;
import java.util.Set;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.container.ResourceInfo;
import jakarta.ws.rs.core.Context;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Reads the bodies of requests: one JSON object. */
final class JsonBodyReader {
    static final String MERGE_PATCH = "application/merge-patch+json";

    /** A connection that sends more is closed. */
    private static final long MAX_READ = 64L * 1024 * 1024;

    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final int BUFFER_BYTES = 8192;

    private JsonBodyReader() {}

    /** Returns an empty object for an empty body. @throws ProblemException if it is not an object or too large */
    static ObjectNode read(InputStream body) throws IOException {
        byte[] bytes = bytes(body, Limits.REQUEST_BYTES);
        if (bytes.length == 0) {
            return NgsiJson.object();
        }
        try {
            JsonNode json = NgsiJson.read(bytes);
            if (json instanceof ObjectNode object) {
                return object;
            }
        } catch (UnreadableException e) {
            throw new ProblemException(ErrorCode.NOT_JSON, "the body is not JSON: " + e.getMessage());
        }
        throw new ProblemException(ErrorCode.NOT_A_REQUEST, "the body is not a JSON object");
    }

    /** Returns the body of a command. @param others members that only other commands of the same path have */
    static ObjectNode read(InputStream body, String command, List<String> others) throws IOException {
        ObjectNode members = read(body);
        for (String other : others) {
            ProblemException.rejectIf(
                    members.hasNonNull(other),
                    ErrorCode.WRONG_MEMBER,
                    "'%s' does not take '%s'".formatted(command, other));
        }
        return members;
    }

    /** Reads at most {@code max} bytes. A larger body is read too but discarded, else many clients would not see the answer. */
    static byte[] bytes(InputStream body, int max) throws IOException {
        ByteArrayOutputStream buffered = new ByteArrayOutputStream();
        if (read(body, max, buffered) > max) {
            throw ProblemException.tooLarge(-1, max);
        }
        return buffered.toByteArray();
    }

    /** Limits the time, because a slow client occupies a thread. */
    private static long read(InputStream body, int max, ByteArrayOutputStream buffered) throws IOException {
        long end = System.nanoTime() + TIMEOUT.toNanos();
        byte[] buffer = new byte[BUFFER_BYTES];
        long total = 0;
        for (int count = body.read(buffer); count >= 0 && total <= MAX_READ; count = body.read(buffer)) {
            total += count;
            if (total <= max) {
                buffered.write(buffer, 0, count);
            }
            if (System.nanoTime() - end > 0) {
                throw new ProblemException(
                        408, "request-timeout", "the body was not received within %d s".formatted(TIMEOUT.toSeconds()));
            }
        }
        return total;
    }

    /**
     * Reads the rest of a body before the answer is written. Otherwise Jetty would close the connection while the
     * client still sends, and the client would not see the answer. A resource without a body may answer on a thread
     * that must not block, therefore its body is read before. Unauthorized clients must not occupy a thread: only
     * available bytes are read, and the answer announces that the connection is closed.
     */
    static final class Drain implements ContainerRequestFilter, ContainerResponseFilter {
        private static final Logger LOG = LoggerFactory.getLogger(Drain.class);
        private static final String CONTINUE = "100-continue";
        private static final Set<Integer> UNREAD = Set.of(401, 403, 408);

        @Context
        private ResourceInfo resource;

        @Override
        public void filter(ContainerRequestContext request) {
            Method method = resource.getResourceMethod(); // null for requests that Jersey answers itself
            boolean takesBody =
                    method != null && Stream.of(method.getParameterTypes()).anyMatch(InputStream.class::equals);
            if (!takesBody) {
                drain(request);
            }
        }

        @Override
        public void filter(ContainerRequestContext request, ContainerResponseContext response) throws IOException {
            if (!UNREAD.contains(response.getStatus())) {
                drain(request);
            } else if (request.getLength() > 0 || request.getHeaderString("Transfer-Encoding") != null) {
                InputStream body = request.getEntityStream();
                while (body.available() > 0) {
                    body.skipNBytes(body.available());
                }
                response.getHeaders().putSingle("Connection", "close");
            }
        }

        private static void drain(ContainerRequestContext request) {
            if (CONTINUE.equalsIgnoreCase(request.getHeaderString("Expect"))) {
                return; // the client does not send the body before the server requests it
            }
            try {
                read(request.getEntityStream(), 0, new ByteArrayOutputStream(0));
            } catch (IOException | ProblemException e) {
                LOG.debug("the rest of a body was not read", e);
            }
        }
    }
}
