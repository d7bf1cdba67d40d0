package io.furrow.simulators.device;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.concurrent.CompletableFuture;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;

/** Posts JSON over HTTP in the tenant and service path of the settings; one attempt, at most ten seconds. */
public final class FiwareHttp {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);

    private final HttpClient client = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(TIMEOUT)
            .build();
    private final FleetSettings settings;

    public FiwareHttp(FleetSettings settings) {
        this.settings = settings;
    }

    /** @throws IOException if the server does not answer; names the address */
    HttpResponse<String> post(URI base, String path, JsonNode body) throws IOException, InterruptedException {
        HttpRequest request = request(base, path, body);
        try {
            return client.send(request, HttpResponse.BodyHandlers.ofString());
        } catch (IOException e) {
            throw new IOException("no answer from " + request.uri() + ": is it running?", e);
        }
    }

    /**
     * Posts asynchronously.
     *
     * @param base as in {@code http://127.0.0.1:1026}
     * @param path with its query
     */
    public CompletableFuture<HttpResponse<String>> postAsync(URI base, String path, JsonNode body) {
        return client.sendAsync(request(base, path, body), HttpResponse.BodyHandlers.ofString());
    }

    private HttpRequest request(URI base, String path, JsonNode body) {
        HttpRequest.Builder request = HttpRequest.newBuilder(
                        URI.create(base.toString().replaceAll("/+$", "") + path))
                .timeout(TIMEOUT)
                .header("Content-Type", "application/json")
                .header("fiware-servicepath", settings.servicePath())
                .POST(HttpRequest.BodyPublishers.ofByteArray(NgsiJson.write(body)));
        if (!settings.fiwareService().isBlank()) {
            request.header("fiware-service", settings.fiwareService());
        }
        settings.token().addTo(request::header);
        return request.build();
    }
}
