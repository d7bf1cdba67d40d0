package io.furrow.control.rest;

import java.io.IOException;
import java.net.Socket;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.ByteBuffer;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Flow;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static java.nio.charset.StandardCharsets.UTF_8;

/** Sends requests to the API and validates each answer against its description. */
public final class ApiClient {
    /** Routes requested by any client. */
    static final Set<String> REQUESTED = ConcurrentHashMap.newKeySet();

    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final OpenApiDocument description = OpenApiDocument.read();
    private final OpenApiDocument version1 = OpenApiDocument.version1();
    private final URI base;
    private final String token;

    ApiClient(URI base, String token) throws IOException {
        this.base = base;
        this.token = token;
    }

    /** @param header empty, or name and value */
    public HttpResponse<byte[]> send(String method, String path, String body, String... header) throws Exception {
        return send(method, path, body, true, header);
    }

    HttpResponse<byte[]> send(String method, String path, String body, boolean described, String... header)
            throws Exception {
        HttpRequest.Builder request = request(method, path, body);
        if (header.length > 0) {
            request.setHeader(header[0], header[1]);
        }
        return send(request, described);
    }

    public int status(String method, String path, String body, String... header) throws Exception {
        return send(method, path, body, header).statusCode();
    }

    public JsonNode get(String path) throws Exception {
        return ask("GET", path, null);
    }

    public JsonNode ask(String method, String path, String body, String... header) throws Exception {
        return json(send(method, path, body, header));
    }

    String error(String method, String path, String body, String... header) throws Exception {
        return error(send(method, path, body, header));
    }

    String error(String method, String path, String body, boolean described) throws Exception {
        return error(send(method, path, body, described));
    }

    private HttpRequest.Builder request(String method, String path, String body) {
        HttpRequest.Builder request = HttpRequest.newBuilder(URI.create(base + path))
                .method(
                        method,
                        body == null ? HttpRequest.BodyPublishers.noBody() : HttpRequest.BodyPublishers.ofString(body));
        if (body != null) {
            request.header("Content-Type", "application/json");
        }
        if (token != null) {
            request.header("Authorization", "Bearer " + token);
        }
        return request;
    }

    private HttpResponse<byte[]> send(HttpRequest.Builder builder, boolean described) throws Exception {
        HttpRequest request = builder.build();
        HttpResponse<byte[]> answer = http.send(
                request,
                head -> head.headers().firstValue("Content-Type").orElse("").startsWith("text/event-stream")
                        ? new FirstBytes()
                        : HttpResponse.BodySubscribers.ofByteArray());
        if (described) {
            String type = answer.headers().firstValue("Content-Type").orElse("").replaceFirst(";.*", "");
            OpenApiDocument document = request.uri().getPath().startsWith("/api/v1/") ? version1 : description;
            REQUESTED.add(document.check(
                    request.method(), request.uri().getPath(), answer.statusCode(), type, answer.body()));
        }
        return answer;
    }

    /** Reads the first bytes of an endless answer. */
    private static final class FirstBytes implements HttpResponse.BodySubscriber<byte[]> {
        private final CompletableFuture<byte[]> body = new CompletableFuture<>();
        private Flow.Subscription subscription;

        @Override
        public CompletionStage<byte[]> getBody() {
            return body;
        }

        @Override
        public void onSubscribe(Flow.Subscription given) {
            subscription = given;
            given.request(1);
        }

        @Override
        public void onNext(List<ByteBuffer> buffers) {
            byte[] bytes = new byte[buffers.get(0).remaining()];
            buffers.get(0).get(bytes);
            subscription.cancel();
            body.complete(bytes);
        }

        @Override
        public void onError(Throwable failure) {
            body.completeExceptionally(failure);
        }

        @Override
        public void onComplete() {
            body.complete(new byte[0]);
        }
    }

    public JsonNode json(HttpResponse<byte[]> answer) throws Exception {
        return NgsiJson.read(answer.body());
    }

    /** Expects status and code of an error. */
    String error(HttpResponse<byte[]> answer) throws Exception {
        return answer.statusCode() + " " + json(answer).path("error").asText();
    }

    /** Returns the answer to a GET with a raw path and host. */
    String raw(String path, String host) throws IOException {
        try (Socket socket = new Socket(base.getHost(), base.getPort())) {
            String request = "GET %s HTTP/1.1\r\nHost: %s\r\nConnection: close\r\n\r\n".formatted(path, host);
            socket.getOutputStream().write(request.getBytes(US_ASCII));
            return new String(socket.getInputStream().readAllBytes(), UTF_8);
        }
    }
}
