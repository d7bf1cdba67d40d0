package io.furrow.fiware.http;

import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import org.eclipse.jetty.http.HttpFields;
import org.eclipse.jetty.util.Fields;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * An HTTP request.
 *
 * @param path the decoded segments
 * @param correlator of the request, or a new one
 */
public record NgsiRequest(
        String method, List<String> path, Fields query, HttpFields headers, Correlator correlator, byte[] body) {
    public static final String SERVICE = "fiware-service";
    public static final String SERVICE_PATH = "fiware-servicepath";
    private static final int DEFAULT_LIMIT = 20;
    private static final int MAX_LIMIT = 1000;

    public Optional<String> parameter(String name) {
        return Optional.ofNullable(query.getValue(name)).filter(value -> !value.isEmpty());
    }

    /** The parts of a comma-separated parameter. */
    public List<String> list(String name) {
        return parameter(name).map(text -> List.of(text.split(","))).orElse(List.of());
    }

    public boolean option(String name) {
        return list("options").contains(name);
    }

    /** The number of elements of a list to skip. */
    public int offset() throws NgsiError {
        return number("offset", 0);
    }

    /** The maximum number of elements of a list to return. */
    public int limit() throws NgsiError {
        int limit = number("limit", DEFAULT_LIMIT);
        if (limit > MAX_LIMIT) {
            throw NgsiError.badRequest("Bad pagination limit: /" + limit + "/ [max: " + MAX_LIMIT + "]");
        }
        return limit;
    }

    private int number(String name, int otherwise) throws NgsiError {
        String text = parameter(name).orElse(Integer.toString(otherwise));
        if (!text.matches("\\d{1,9}")) {
            throw NgsiError.badRequest("Bad pagination " + name + ": /" + text + "/ [must be a decimal number]");
        }
        return Integer.parseInt(text);
    }

    public boolean lacks(String header) {
        return !headers.contains(header);
    }

    public String service() throws NgsiError {
        String service = FiwareScope.of(headers.get(SERVICE), null).service();
        if (!service.matches("[a-z0-9_]{0,50}")) {
            throw NgsiError.badRequest(
                    "bad character in tenant name - only underscore and alphanumeric characters are allowed");
        }
        return service;
    }

    /** The scope of an update. */
    public FiwareScope scope() throws NgsiError {
        String path = headers.get(SERVICE_PATH);
        FiwareScope scope = FiwareScope.of(service(), path);
        checkPath(scope.servicePath());
        if (scope.servicePath().contains(",") || scope.servicePath().contains("#")) {
            throw NgsiError.badRequest("more than one service path in an update: " + path);
        }
        return scope;
    }

    /** The service paths of a query or subscription; all without a header. */
    public PathFilter paths() throws NgsiError {
        String path = headers.get(SERVICE_PATH);
        PathFilter paths = PathFilter.of(path == null || path.isBlank() ? PathFilter.EVERYWHERE : path.trim());
        for (String pattern : paths.patterns()) {
            checkPath(pattern);
        }
        return paths;
    }

    public JsonNode json() throws NgsiError {
        requireJson();
        try {
            return NgsiJson.read(body);
        } catch (UnreadableException e) {
            throw NgsiError.notJson();
        }
    }

    public void requireJson() throws NgsiError {
        String type = headers.get("Content-Type");
        String bare = type == null ? "" : type.split(";")[0].trim();
        if (!bare.equals("application/json")) {
            throw NgsiError.badMediaType(bare);
        }
    }

    private static void checkPath(String path) throws NgsiError {
        if (!path.startsWith("/")) {
            throw NgsiError.badRequest("Only /absolute/ Service Paths allowed [a service path must begin with /]");
        }
        if (!path.matches("/|(/[A-Za-z0-9_]{1,50}){1,10}(/#)?|/#")) {
            throw NgsiError.badRequest("a component of ServicePath contains an illegal character");
        }
    }
}
