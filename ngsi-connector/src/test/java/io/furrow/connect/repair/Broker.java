package io.furrow.connect.repair;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.ngsi.NgsiJson;

/** The context broker of the simulators, and a client of it for one tenant. */
public final class Broker implements AutoCloseable {
    private final HttpClient client =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final FiwareStandIn standIn;
    private final String tenant;

    public Broker(FiwareSettings settings, String tenant) {
        standIn = FiwareStandIn.start(settings);
        this.tenant = tenant;
    }

    public URI uri() {
        return standIn.contextBroker();
    }

    public FiwareStandIn standIn() {
        return standIn;
    }

    /** Makes the entity or changes it. */
    public void put(String servicePath, String id, String type, int value) {
        String body = "{\"id\": \"%s\", \"type\": \"%s\", \"t\": {\"type\": \"Number\", \"value\": %d}}"
                .formatted(id, type, value);
        expect(204, 201, send("POST", "/v2/entities?options=upsert", servicePath, body));
    }

    public void delete(String servicePath, String id) {
        expect(204, 204, send("DELETE", "/v2/entities/" + id, servicePath, ""));
    }

    public JsonNode subscriptions() {
        return json(send("GET", "/v2/subscriptions?limit=1000", "/#", "").body());
    }

    public HttpResponse<String> send(String method, String path, String servicePath, String body) {
        HttpRequest.Builder request = HttpRequest.newBuilder(uri().resolve(path))
                .method(method, body.isEmpty() ? BodyPublishers.noBody() : BodyPublishers.ofString(body))
                .header("fiware-servicepath", servicePath);
        if (!tenant.isEmpty()) {
            request.header("fiware-service", tenant);
        }
        if (!body.isEmpty()) {
            request.header("Content-Type", "application/json");
        }
        return client.sendAsync(request.build(), HttpResponse.BodyHandlers.ofString())
                .join();
    }

    private static void expect(int one, int other, HttpResponse<String> answer) {
        if (answer.statusCode() != one && answer.statusCode() != other) {
            throw new AssertionError(answer + " " + answer.body());
        }
    }

    private static JsonNode json(String text) {
        try {
            return NgsiJson.mapper().readTree(text);
        } catch (com.fasterxml.jackson.core.JsonProcessingException e) {
            throw new AssertionError(text, e);
        }
    }

    @Override
    public void close() {
        standIn.close();
    }
}
