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

/** Asks the control plane whose token it is. An answer counts for some seconds, so a token that is taken back does not for longer. */
public final class UserCache {
    /** Error of a user whom a proxy names and the control plane does not take. */
    public static final String NOT_TAKEN = "users-not-taken";

    static final Duration REMEMBERED = Duration.ofSeconds(10);
    private static final int MAX_REMEMBERED = 1_000;
    private static final Duration TIMEOUT = Duration.ofSeconds(5);

    private final HttpClient client =
            HttpClient.newBuilder().connectTimeout(TIMEOUT).build();
    private final URI controlPlane;
    private final LongSupplier nanos;
    private final Map<String, CachedUser> cached = BoundedMap.byInsertion(MAX_REMEMBERED);

    private record CachedUser(User user, long since) {}

    /** @param controlPlane base of its REST API */
    public UserCache(URI controlPlane, LongSupplier nanos) {
        this.controlPlane = controlPlane;
        this.nanos = nanos;
    }

    /**
     * @throws Problem 401 where the control plane does not know the token, 503 where it does not answer, or does not take the dashboard's
     *     word for its users
     */
    public User find(Credentials credentials) {
        String key = Sha256.hex(
                "%s\n%s\n%s" // the tokens themselves are kept nowhere
                        .formatted(credentials.authorization(), credentials.user(), credentials.role()));
        synchronized (cached) {
            CachedUser before = cached.get(key);
            if (before != null && nanos.getAsLong() - before.since() < REMEMBERED.toNanos()) {
                return before.user();
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
        URI me = URI.create(controlPlane.toString().replaceAll("/+$", "") + "/api/me");
        HttpRequest.Builder request = HttpRequest.newBuilder(me).timeout(TIMEOUT);
        credentials.addTo(request);
        try {
            HttpResponse<byte[]> answer = client.send(request.build(), HttpResponse.BodyHandlers.ofByteArray());
            boolean refuses = answer.statusCode() == 401 || answer.statusCode() == 403;
            if (refuses && credentials.isOfProxy()) {
                throw notTaken(reason(answer.body()));
            } else if (refuses) {
                throw new Problem(401, "unauthorized", reason(answer.body()));
            } else if (answer.statusCode() != 200) {
                throw unavailable(me, "it answers " + answer.statusCode());
            }
            JsonNode user = NgsiJson.read(answer.body());
            String name = user.path("user").asText();
            if (credentials.isOfProxy()
                    && !name.equals(credentials.user())) { // it asks for no tokens, or is an older one
                throw notTaken("it says that the request is from '" + name + "'");
            }
            return new User(
                    name, Role.of(user.path("role").asText()).orElseThrow(() -> unavailable(me, "it names no role")));
        } catch (IOException | UnreadableException e) {
            throw unavailable(me, FailureText.of(e));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw unavailable(me, "the dashboard stops");
        }
    }

    private static Problem notTaken(String why) {
        return new Problem(
                503,
                NOT_TAKEN,
                "the control plane does not take users from the dashboard (%s); start it with --api-tokens, and let the line of the token in --proxy-token-file end with 'for-users'"
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
                "the control plane, which knows who may do what, cannot be asked at %s (%s); check --control-plane and that it runs"
                        .formatted(me, why));
    }
}
