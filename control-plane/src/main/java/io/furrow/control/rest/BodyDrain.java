package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.lang.reflect.Method;
import java.util.Set;
import java.util.stream.Stream;

import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.container.ResourceInfo;
import jakarta.ws.rs.core.Context;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Reads what was left of a body before the answer is written. Otherwise Jetty ends the connection while the client still sends, or sends
 * its next request, and the client sees no answer. A resource that takes no body may answer on a thread that must not wait: its body is
 * read before. Whoever is refused for who he is may occupy no thread: what has come is read, then his connection ends, and the answer
 * says so.
 */
final class BodyDrain implements ContainerRequestFilter, ContainerResponseFilter {
    private static final Logger LOG = LoggerFactory.getLogger(BodyDrain.class);
    private static final String CONTINUE = "100-continue";
    private static final Set<Integer> UNREAD = Set.of(401, 403, 408);

    @Context
    private ResourceInfo resource;

    @Override
    public void filter(ContainerRequestContext request) {
        Method method = resource.getResourceMethod(); // null of what Jersey answers by itself
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
            return; // the client sends none before it is asked to
        }
        try {
            Body.drain(request.getEntityStream());
        } catch (IOException | ProblemException e) {
            LOG.debug("the rest of a body was not read", e);
        }
    }
}
