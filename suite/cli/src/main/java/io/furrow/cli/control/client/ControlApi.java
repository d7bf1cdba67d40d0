package io.furrow.cli.control.client;

import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.net.HttpURLConnection;
import java.net.URI;
import java.net.URLEncoder;
import java.util.Map;
import java.util.Objects;
import java.util.StringJoiner;
import java.util.UUID;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import java.util.function.Predicate;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import javax.net.ssl.HttpsURLConnection;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLSocketFactory;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.MissingNode;

import io.furrow.cli.control.table.ControlTable;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Client of the REST API of a control plane. A request that it cannot take yet is retried under the same idempotency key. */
public final class ControlApi {
    private static final int CONNECT_TIMEOUT_MS = 5_000;
    private static final int READ_TIMEOUT_MS = 40_000;
    private static final int ATTEMPTS = 10;
    private static final int NOT_READY = 503;
    private static final int NO_TOKEN = 401;
    static final int UNKNOWN = 404;
    private static final int AFTER_SECONDS = 1;
    private static final int MAX_PAGES = 20;
    private static final String JSON = "application/json";
    /** The dashboard answers the last of them, without a version. */
    private static final Pattern UNVERSIONED = Pattern.compile("^/api/(?!v1/|platform$)");

    private static final Pattern NEXT = Pattern.compile("<(\\?[^>]*)>; ?rel=\"next\"");

    static {
        // A command without an answer is repeated by its idempotency key only.
        System.setProperty("sun.net.http.retryPost", "false");
    }

    private final URI base;
    private final String token;
    private final boolean isoTimes;
    /** One for all connections, for only those of the same factory are kept; null for that of Java. */
    private final SSLSocketFactory sockets;

    /** @param link to further pages; may be empty */
    record Answer(int status, String retryAfter, String link, byte[] body) {}

    /** Elements of a list. @param hasMore whether there are, or may be, others */
    public record Page(ArrayNode elements, boolean hasMore) {}

    /**
     * @param base as in {@code http://127.0.0.1:8085}
     * @param token null if none is required
     */
    public ControlApi(URI base, String token) {
        this(base, token, null, false);
    }

    /**
     * @param trust the certificates to trust over https; null for those that Java trusts
     * @param isoTimes whether times of answers are in ISO 8601, as version 1 has them, not in epoch ms
     */
    ControlApi(URI base, String token, SSLContext trust, boolean isoTimes) {
        this.base = base;
        this.token = token;
        this.isoTimes = isoTimes;
        this.sockets = trust == null ? null : trust.getSocketFactory();
    }

    /** Escapes a name as a part of a path. */
    public static String part(String name) {
        return "/" + encoded(name);
    }

    private static String encoded(String text) {
        return URLEncoder.encode(text, UTF_8).replace("+", "%20");
    }

    /** The query of the parameters that are present; empty if none is. */
    public static String query(Map<String, ?> parameters) {
        StringJoiner query = new StringJoiner("&", "?", "").setEmptyValue("");
        parameters.forEach((name, value) -> {
            if (value != null) {
                query.add(name + "=" + encoded(value.toString()));
            }
        });
        return query.toString();
    }

    /** @throws ControlPlaneException if it is unavailable or refuses */
    public JsonNode get(String path) {
        return send("GET", path, null);
    }

    /** As {@link #get}, with one attempt. */
    public JsonNode once(String path) {
        return read(succeeded(exchange("GET", path, null, JSON, null)));
    }

    /** Gets {@code /ready}, whether it is or not. @throws ControlPlaneException if it is unavailable */
    public JsonNode ready() {
        return read(exchange("GET", "/ready", null, JSON, null));
    }

    /**
     * @param body null for none
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public JsonNode send(String method, String path, JsonNode body) {
        return read(answer(method, path, body, JSON));
    }

    /**
     * Gets a path in another media type than JSON.
     *
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public String text(String path, String type) {
        return new String(answer("GET", path, null, type).body(), UTF_8);
    }

    /**
     * Gets a list, following its links to further pages: one of them may hold few elements, or none.
     *
     * @param limit how many elements to return at most
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public Page list(String path, int limit) {
        return list(path, limit, element -> false);
    }

    /** As {@link #list(String, int)}. @param isLast of an element: its page is the last that is read */
    public Page list(String path, int limit, Predicate<JsonNode> isLast) {
        ArrayNode elements = NgsiJson.array();
        String next = path;
        boolean ended = false;
        for (int page = 0; next != null && !ended && elements.size() < limit && page < MAX_PAGES; page++) {
            Answer answer = answer("GET", next, null, JSON);
            for (JsonNode element : ControlTable.rows(read(answer))) {
                elements.add(element);
                ended |= isLast.test(element);
            }
            next = next(path, answer);
        }
        boolean tooMany = elements.size() > limit;
        while (elements.size() > limit) {
            elements.remove(limit);
        }
        return new Page(elements, tooMany || next != null);
    }

    /** Gets all pages of a list, however many there are. */
    public void pages(String path, Consumer<JsonNode> page) {
        for (String next = path; next != null; ) {
            Answer answer = answer("GET", next, null, JSON);
            page.accept(read(answer));
            next = next(path, answer);
        }
    }

    /** The path of the next page; null for none. */
    private static String next(String path, Answer answer) {
        Matcher link = NEXT.matcher(answer.link());
        return link.find() ? path.replaceFirst("\\?.*", "") + link.group(1) : null;
    }

    private Answer answer(String method, String path, JsonNode body, String accept) {
        String key = method.equals("GET") ? null : UUID.randomUUID().toString();
        Answer answer = exchange(method, path, body, accept, key);
        for (int attempt = 1; answer.status() == NOT_READY && attempt < ATTEMPTS; attempt++) {
            sleep(answer.retryAfter());
            answer = exchange(method, path, body, accept, key);
        }
        return succeeded(answer);
    }

    Answer succeeded(Answer answer) {
        if (answer.status() / 100 == 2) {
            return answer;
        }
        JsonNode json = read(answer);
        String reason = json.path("reason").asText("it answers " + answer.status());
        if (answer.status() == NO_TOKEN) {
            throw new ControlPlaneException(
                    "The control plane at %s asks who you are: %s. Name a file with your token with --token-file, or set FURROW_TOKEN."
                            .formatted(base, reason));
        }
        String code = json.path("error").asText();
        throw new ControlPlaneException(
                code.isEmpty() ? reason : reason + " (" + code + ")",
                answer.status() == UNKNOWN,
                json.isObject() ? json : null);
    }

    private Answer exchange(String method, String path, JsonNode body, String accept, String key) {
        try {
            HttpURLConnection connection = open(method, path, accept);
            if (key != null) {
                connection.setRequestProperty("Idempotency-Key", key);
            }
            if (body != null || method.equals("POST")) { // some proxies refuse a POST without a length
                connection.setRequestProperty("Content-Type", JSON);
                connection.setDoOutput(true);
                try (OutputStream out = connection.getOutputStream()) {
                    out.write(NgsiJson.write(body == null ? NgsiJson.object() : body));
                }
            }
            return received(connection);
        } catch (IOException e) {
            throw noAnswer(e);
        }
    }

    static Answer received(HttpURLConnection connection) throws IOException {
        int status = connection.getResponseCode();
        try (InputStream answer = status < 400 ? connection.getInputStream() : connection.getErrorStream()) {
            String retryAfter = Objects.requireNonNullElse(connection.getHeaderField("Retry-After"), "");
            String link = Objects.requireNonNullElse(connection.getHeaderField("Link"), "");
            return new Answer(status, retryAfter, link, answer == null ? new byte[0] : answer.readAllBytes());
        }
    }

    ControlPlaneException noAnswer(IOException e) {
        return ControlPlaneException.noAnswer(base, e);
    }

    /** Uses a client without threads of its own, for which the JVM would wait at the end, and without PATCH. */
    HttpURLConnection open(String method, String path, String accept) throws IOException {
        String versioned = isoTimes ? UNVERSIONED.matcher(path).replaceFirst("/api/v1/") : path;
        URI uri = URI.create(base.toString().replaceAll("/+$", "") + versioned);
        HttpURLConnection connection = (HttpURLConnection) uri.toURL().openConnection();
        if (sockets != null && connection instanceof HttpsURLConnection encrypted) {
            encrypted.setSSLSocketFactory(sockets);
        }
        connection.setConnectTimeout(CONNECT_TIMEOUT_MS);
        connection.setReadTimeout(READ_TIMEOUT_MS);
        connection.setInstanceFollowRedirects(false);
        connection.setRequestMethod(method.equals("PATCH") ? "POST" : method);
        if (method.equals("PATCH")) {
            connection.setRequestProperty("X-HTTP-Method-Override", method);
        }
        connection.setRequestProperty("Accept", accept);
        if (token != null) {
            connection.setRequestProperty("Authorization", "Bearer " + token);
        }
        return connection;
    }

    private static void sleep(String seconds) {
        try {
            TimeUnit.SECONDS.sleep(seconds.matches("[0-9]{1,2}") ? Integer.parseInt(seconds) : AFTER_SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new ControlPlaneException("interrupted while waiting for the control plane", e);
        }
    }

    JsonNode read(Answer answer) {
        try {
            return answer.body().length == 0 ? MissingNode.getInstance() : NgsiJson.read(answer.body());
        } catch (UnreadableException e) {
            throw new ControlPlaneException(
                    "%s answers %d and what is not JSON: is it a control plane? Check --api, or what is between."
                            .formatted(base, answer.status()),
                    e);
        }
    }
}
