package io.furrow.dashboard.auth;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.Map;
import java.util.function.LongSupplier;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.dashboard.http.Problem;
import io.furrow.kafka.BoundedMap;
import io.furrow.model.control.Role;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.text.Sha256;

/**
 * Finds the user of a token by asking the control plane. Caches the answer for {@link #TIME_TO_LIVE}, after which a
 * revoked token is rejected.
 */
public final class UserCache {
    /** Error if the control plane does not accept users that a proxy names. */
    public static final String USERS_NOT_ACCEPTED = "users-not-taken";

    static final Duration TIME_TO_LIVE = Duration.ofSeconds(10);
    private static final int MAX_CACHED = 1_000;
    private static final Duration TIMEOUT = Duration.ofSeconds(5);

    private final HttpClient client =
            HttpClient.newBuilder().connectTimeout(TIMEOUT).build();
    private final URI controlPlane;
    private final LongSupplier nanos;
    private final Map<String, CachedUser> cached = BoundedMap.byInsertion(MAX_CACHED);

    private record CachedUser(User user, long since) {}

    /** @param controlPlane base URL of its REST API */
    public UserCache(URI controlPlane, LongSupplier nanos) {
        this.controlPlane = controlPlane;
        this.nanos = nanos;
    }

    /**
     * @throws Problem 401 if the control plane does not know the token; 503 if it does not respond, or does not accept
     *     users from the dashboard
     */
    public User find(Credentials credentials) {
        String key = Sha256.hex(
                "%s\n%s\n%s" // tokens are not stored
                        .formatted(credentials.authorization(), credentials.user(), credentials.role()));
        synchronized (cached) {
            CachedUser existing = cached.get(key);
            if (existing != null && nanos.getAsLong() - existing.since() < TIME_TO_LIVE.toNanos()) {
                return existing.user();
            }
        }
        User user = request(credentials);
        synchronized (cached) {
            cached.remove(key);
            cached.put(key, new CachedUser(user, nanos.getAsLong()));
        }
        return user;
    }

    private User request(Credentials credentials) {
        URI me = URI.create(controlPlane + "/api/me");
        HttpRequest.Builder request = HttpRequest.newBuilder(me).timeout(TIMEOUT);
        credentials.addTo(request);
        try {
            HttpResponse<byte[]> answer = client.send(request.build(), HttpResponse.BodyHandlers.ofByteArray());
            boolean isRejected = answer.statusCode() == 401 || answer.statusCode() == 403;
            if (isRejected && credentials.isOfProxy()) {
                throw usersNotAccepted(reason(answer.body()));
            } else if (isRejected) {
                throw new Problem(401, "unauthorized", reason(answer.body()));
            } else if (answer.statusCode() != 200) {
                throw unavailable(me, "it answers " + answer.statusCode());
            }
            JsonNode user = NgsiJson.read(answer.body());
            String name = user.path("user").asText();
            if (credentials.isOfProxy()
                    && !name.equals(credentials.user())) { // the control plane has no tokens, or is an older version
                throw usersNotAccepted("it says that the request is from '" + name + "'");
            }
            return new User(
                    name, Role.of(user.path("role").asText()).orElseThrow(() -> unavailable(me, "it names no role")));
        } catch (IOException | UnreadableException e) {
            throw unavailable(me, FailureText.of(e));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw unavailable(me, "the dashboard is stopping");
        }
    }

    private static Problem usersNotAccepted(String why) {
        return new Problem(
                503,
                USERS_NOT_ACCEPTED,
                "the control plane does not accept users from the dashboard (%s); start it with --api-tokens, and let the line of the token in --proxy-token-file end with 'for-users'"
                        .formatted(why));
    }

    private static String reason(byte[] body) {
        try {
            return NgsiJson.read(body).path("reason").asText("the control plane does not know the token");
        } catch (UnreadableException e) {
            return "the control plane does not know the token";
        }
    }

    private static Problem unavailable(URI me, String why) {
        return new Problem(
                503,
                "control-plane-away",
                "the control plane cannot authenticate users at %s (%s); check --control-plane and that it runs"
                        .formatted(me, why));
    }
}
