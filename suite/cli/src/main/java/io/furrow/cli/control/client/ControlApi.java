package io.furrow.cli.control.client;

import java.io.IOException;
import java.net.URI;
import java.net.URLEncoder;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublisher;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.net.http.HttpResponse.BodyHandler;
import java.net.http.HttpResponse.BodyHandlers;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.UUID;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLException;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.MissingNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/** Client of the REST API of a control plane. A request that it cannot take yet is retried under the same idempotency key. */
public final class ControlApi {
    private static final Duration TIMEOUT = Duration.ofSeconds(40);
    private static final int ATTEMPTS = 10;
    private static final int NOT_READY = 503;
    private static final int NO_TOKEN = 401;
    private static final int UNKNOWN = 404;
    private static final int AFTER_SECONDS = 1;

    private final HttpClient http;
    private final URI base;
    private final String token;

    /**
     * @param base as in {@code http://127.0.0.1:8085}
     * @param token null if none is required
     */
    public ControlApi(URI base, String token) {
        this(base, token, null);
    }

    /** @param trust the certificates to trust over https; null for those that Java trusts */
    ControlApi(URI base, String token, SSLContext trust) {
        this.base = base;
        this.token = token;
        HttpClient.Builder client =
                HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).connectTimeout(Duration.ofSeconds(5));
        SSLContext context = trust == null && "http".equals(base.getScheme()) ? NoTls.CONTEXT : trust;
        this.http = (context == null ? client : client.sslContext(context)).build();
    }

    /** Escapes a name as a part of a path. */
    public static String part(String name) {
        return "/" + URLEncoder.encode(name, StandardCharsets.UTF_8).replace("+", "%20");
    }

    /** @throws ControlPlaneException if it is unavailable or refuses */
    public JsonNode get(String path) {
        return send("GET", path, null);
    }

    /**
     * @param body null for none
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public JsonNode send(String method, String path, JsonNode body) {
        return read(answer(request(method, path, body).build()));
    }

    /**
     * Gets a path in another media type than JSON.
     *
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public String text(String path, String type) {
        HttpRequest request =
                request("GET", path, null).setHeader("Accept", type).build();
        return new String(answer(request), StandardCharsets.UTF_8);
    }

    private byte[] answer(HttpRequest request) {
        HttpResponse<byte[]> answer = exchange(request, BodyHandlers.ofByteArray());
        for (int attempt = 1; answer.statusCode() == NOT_READY && attempt < ATTEMPTS; attempt++) {
            sleep(answer.headers().firstValue("Retry-After").orElse(""));
            answer = exchange(request, BodyHandlers.ofByteArray());
        }
        if (answer.statusCode() / 100 == 2) {
            return answer.body();
        }
        JsonNode json = read(answer.body());
        String reason = json.path("reason").asText("it answers " + answer.statusCode());
        if (answer.statusCode() == NO_TOKEN) {
            throw new ControlPlaneException(
                    "The control plane at %s asks who you are: %s. Name a file with your token with --token-file, or set FURROW_TOKEN."
                            .formatted(base, reason));
        }
        String code = json.path("error").asText();
        throw new ControlPlaneException(
                code.isEmpty() ? reason : reason + " (" + code + ")", answer.statusCode() == UNKNOWN);
    }

    /**
     * Lines of an event stream, until it ends or the stream is closed.
     *
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public Stream<String> events(String path) {
        HttpResponse<Stream<String>> answer = exchange(
                request("GET", path, null)
                        .setHeader("Accept", "text/event-stream")
                        .build(),
                BodyHandlers.ofLines());
        if (answer.statusCode() / 100 != 2) {
            answer.body().close();
            throw new ControlPlaneException(
                    "The control plane at %s answers %d to %s".formatted(base, answer.statusCode(), path),
                    answer.statusCode() == UNKNOWN);
        }
        return answer.body();
    }

    private HttpRequest.Builder request(String method, String path, JsonNode body) {
        BodyPublisher publisher =
                body == null ? BodyPublishers.noBody() : BodyPublishers.ofByteArray(NgsiJson.write(body));
        HttpRequest.Builder request = HttpRequest.newBuilder(
                        URI.create(base.toString().replaceAll("/+$", "") + path))
                .timeout(TIMEOUT)
                .header("Accept", "application/json")
                .method(method, publisher);
        if (!method.equals("GET")) {
            request.header("Idempotency-Key", UUID.randomUUID().toString());
        }
        if (body != null) {
            request.header("Content-Type", "application/json");
        }
        if (token != null) {
            request.header("Authorization", "Bearer " + token);
        }
        return request;
    }

    private <T> HttpResponse<T> exchange(HttpRequest request, BodyHandler<T> body) {
        try {
            return http.send(request, body);
        } catch (SSLException e) {
            throw new ControlPlaneException(
                    "The control plane at %s cannot be trusted (%s). Name the certificate of its CA with --api-ca."
                            .formatted(base, FailureText.of(e)),
                    e);
        } catch (IOException e) {
            throw new ControlPlaneException(
                    "No control plane answers at %s. Is it running? ./furrow up starts one; --api names another."
                            .formatted(base),
                    e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new ControlPlaneException("interrupted while waiting for " + base, e);
        }
    }

    private static void sleep(String seconds) {
        try {
            TimeUnit.SECONDS.sleep(seconds.matches("[0-9]{1,2}") ? Integer.parseInt(seconds) : AFTER_SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new ControlPlaneException("interrupted while waiting for the control plane", e);
        }
    }

    private JsonNode read(byte[] body) {
        try {
            return body.length == 0 ? MissingNode.getInstance() : NgsiJson.read(body);
        } catch (UnreadableException e) {
            throw new ControlPlaneException(base + " answers what is not JSON: is it a control plane? Check --api.", e);
        }
    }
}
