package io.furrow.bench.control;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.concurrent.CompletableFuture;

import io.furrow.model.ngsi.NgsiJson;

/** Sends requests over the REST API, where an answer cannot be repeated. */
final class RestControlClient implements ControlClient {
    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final URI api;

    RestControlClient(URI api) {
        this.api = api;
    }

    @Override
    public CompletableFuture<String> ask(ControlRequest request, String id) {
        HttpRequest asked = HttpRequest.newBuilder(URI.create(api + request.path()))
                .header("Content-Type", "application/json")
                .header("Idempotency-Key", id)
                .method(request.method(), HttpRequest.BodyPublishers.ofByteArray(NgsiJson.write(request.members())))
                .build();
        return http.sendAsync(asked, HttpResponse.BodyHandlers.discarding())
                .thenApply(answer ->
                        answer.statusCode() / 100 == 2 ? request.expected() : "no success, but " + answer.statusCode());
    }
}
