package io.furrow.fiware;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Speaks to one of the APIs as one tenant. */
public record Client(URI base, String service, String servicePath, List<String> headers) {
    private static final HttpClient HTTP =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();

    /** An answer; {@code location} is empty if none was given. */
    public record Answer(int status, String body, String location, String total) {
        public JsonNode json() {
            try {
                return NgsiJson.read(body.getBytes(java.nio.charset.StandardCharsets.UTF_8));
            } catch (UnreadableException e) {
                throw new AssertionError("an answer that is not JSON: " + body, e);
            }
        }
    }

    public static Client of(URI base) {
        return new Client(base, "agri", "/plot1", List.of());
    }

    public Client as(String otherService, String otherPath) {
        return new Client(base, otherService, otherPath, headers);
    }

    public Client with(String name, String value) {
        List<String> more = new ArrayList<>(headers);
        more.addAll(List.of(name, value));
        return new Client(base, service, servicePath, more);
    }

    public Answer get(String path) {
        return send("GET", path, "");
    }

    /** The value of an attribute; missing if the entity does not have it. */
    public JsonNode value(String entity, String attribute) {
        return get("/v2/entities/" + entity).json().path(attribute).path("value");
    }

    public Answer post(String path, String json) {
        return send("POST", path, json);
    }

    public Answer patch(String path, String json) {
        return send("PATCH", path, json);
    }

    public Answer delete(String path) {
        return send("DELETE", path, "");
    }

    public Answer send(String method, String path, String body) {
        HttpRequest.Builder request = HttpRequest.newBuilder(base.resolve(path))
                .method(
                        method,
                        body.isEmpty()
                                ? HttpRequest.BodyPublishers.noBody()
                                : HttpRequest.BodyPublishers.ofString(body));
        if (!service.isEmpty()) {
            request.header("fiware-service", service).header("fiware-servicepath", servicePath);
        }
        if (!headers.isEmpty()) {
            request.headers(headers.toArray(String[]::new));
        }
        if (!body.isEmpty() && !headers.contains("Content-Type")) {
            request.header("Content-Type", "application/json");
        }
        try {
            HttpResponse<String> response = HTTP.send(request.build(), HttpResponse.BodyHandlers.ofString());
            return new Answer(
                    response.statusCode(),
                    response.body(),
                    response.headers().firstValue("Location").orElse(""),
                    response.headers().firstValue("Fiware-Total-Count").orElse(""));
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException("interrupted while waiting for " + path, e);
        }
    }
}
