package io.furrow.suite;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.launcher.suite.Suite;
import io.furrow.model.ngsi.NgsiJson;

/** A client of the context broker and of the NGSI source. */
public record Ngsi(Suite suite) {
    private static final HttpClient HTTP =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();

    /** The entities that match a query such as {@code type=Camera}. */
    JsonNode entities(String query) throws IOException, InterruptedException {
        HttpRequest request = HttpRequest.newBuilder(suite.contextBroker().resolve("/v2/entities?limit=1000&" + query))
                .header("fiware-service", suite.fiwareService())
                .header("fiware-servicepath", "/#")
                .build();
        return NgsiJson.mapper()
                .readTree(HTTP.send(request, HttpResponse.BodyHandlers.ofByteArray())
                        .body());
    }

    JsonNode entity(String id) throws IOException, InterruptedException {
        return entities("id=" + id).path(0);
    }

    /** Sends a notification to the NGSI source and returns the status of its response. */
    int notify(byte[] body) throws IOException, InterruptedException {
        return send(suite.listener(), body);
    }

    /** Creates or updates an entity in normalized form. */
    public int append(String entities) throws IOException, InterruptedException {
        return update("append", entities);
    }

    /** Deletes an entity. */
    public int delete(String id) throws IOException, InterruptedException {
        return update("delete", "{\"id\":\"" + id + "\"}");
    }

    private int update(String action, String entities) throws IOException, InterruptedException {
        String update = "{\"actionType\":\"" + action + "\",\"entities\":[" + entities + "]}";
        return send(
                suite.contextBroker().resolve("/v2/op/update"),
                update.getBytes(java.nio.charset.StandardCharsets.UTF_8));
    }

    private int send(URI uri, byte[] body) throws IOException, InterruptedException {
        HttpRequest request = HttpRequest.newBuilder(uri)
                .header("Content-Type", "application/json")
                .header("fiware-service", suite.fiwareService())
                .header("fiware-servicepath", "/")
                .POST(BodyPublishers.ofByteArray(body))
                .build();
        return HTTP.send(request, HttpResponse.BodyHandlers.discarding()).statusCode();
    }
}
