package io.furrow.control.alarm;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;
import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.time.ZonedDateTime;
import java.time.format.DateTimeFormatter;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Posts alarms to a URL, as JSON: the record of {@code service.alarms} with {@code id}, signed where there is a secret. Redirects are
 * not followed, and at most {@value BoundedBody#MAX_BYTES} bytes of an answer are read.
 */
public final class Webhook {
    static final String SIGNATURE = "Furrow-Signature";
    static final String DELIVERY = "Furrow-Delivery";

    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final Duration MAX_RETRY_AFTER = Duration.ofHours(1);
    /** Answers that say "later" though they are of the kind that says "never". */
    private static final Set<Integer> TEMPORARY = Set.of(408, 425, 429);

    private final URI url;
    private final WebhookSecret secret;
    private final Clock clock;
    private final HttpClient client = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .followRedirects(HttpClient.Redirect.NEVER)
            .connectTimeout(TIMEOUT)
            .build();

    /**
     * Where to post to, and when. The URL may hold a secret: it is not logged but for its host.
     *
     * @param url absolute, http or https
     * @param secret file with the secret that bodies are signed with; null for none
     * @param groupWait how long an alarm that is less than major waits for one that inhibits it
     * @param repeatInterval after how long an alarm that is open is posted again
     */
    public record Settings(URI url, Path secret, Duration groupWait, Duration repeatInterval) {
        /** @throws IllegalArgumentException where the URL is none that can be posted to */
        public Settings {
            boolean http = "http".equalsIgnoreCase(url.getScheme()) || "https".equalsIgnoreCase(url.getScheme());
            if (!http || url.getHost() == null) {
                throw new IllegalArgumentException(
                        "the webhook's URL is no absolute http or https URL with a host: " + url);
            }
        }

        /** Not signed; waits for ten seconds, repeats after four hours. */
        public static Settings of(URI url) {
            return new Settings(url, null, Duration.ofSeconds(10), Duration.ofHours(4));
        }

        public Settings signedWith(Path file) {
            return new Settings(url, file, groupWait, repeatInterval);
        }

        /** The same settings. @throws IOException if the secret cannot be used; the message says why and what to do */
        public Settings checked() throws IOException {
            if (secret != null) {
                WebhookSecret.read(secret);
            }
            return this;
        }

        public Settings withGroupWait(Duration time) {
            return new Settings(url, secret, time, repeatInterval);
        }
    }

    /** What came of a post. */
    enum Outcome {
        TAKEN,
        /** It would be refused again. */
        REFUSED,
        /** It may be taken later. */
        FAILED
    }

    /**
     * @param reason null where it was taken
     * @param retryAfter how long nothing is to be posted; null where nothing was said
     */
    record Answer(Outcome outcome, String reason, Duration retryAfter) {
        static Answer failed(String reason) {
            return new Answer(Outcome.FAILED, reason, null);
        }
    }

    /** @throws IOException if the secret cannot be read; the message says what to do */
    Webhook(Settings settings, Clock clock) throws IOException {
        this.url = settings.url();
        this.secret = settings.secret() == null ? null : WebhookSecret.read(settings.secret());
        this.clock = clock;
    }

    /**
     * Posts it once. The future completes normally, also where no answer arrives in time.
     *
     * @param id of the delivery, the same however often it is posted
     */
    CompletableFuture<Answer> post(String id, Alarm alarm) {
        HttpRequest request = request(id, body(id, alarm));
        CompletableFuture<HttpResponse<Void>> sent = client.sendAsync(request, BoundedBody::discarding);
        // The request's own timeout ends with the headers; a body may take for ever.
        CompletableFuture.delayedExecutor(TIMEOUT.toMillis(), TimeUnit.MILLISECONDS)
                .execute(() -> sent.cancel(true));
        return sent.handle((response, failure) -> failure == null ? answer(response) : Answer.failed(reason(failure)));
    }

    private HttpRequest request(String id, byte[] body) {
        HttpRequest.Builder request = HttpRequest.newBuilder(url)
                .timeout(TIMEOUT)
                .header("Content-Type", "application/json")
                .header(DELIVERY, id)
                .POST(HttpRequest.BodyPublishers.ofByteArray(body));
        if (secret != null) {
            request.header(SIGNATURE, secret.signature(clock.instant().getEpochSecond(), body));
        }
        return request.build();
    }

    private Answer answer(HttpResponse<Void> response) {
        int status = response.statusCode();
        if (status / 100 == 2) {
            return new Answer(Outcome.TAKEN, null, null);
        }
        if (status / 100 == 4 && !TEMPORARY.contains(status)) {
            return new Answer(Outcome.REFUSED, "it answers " + status, null);
        }
        String reason = status / 100 == 3
                ? "it answers %d, and redirects are not followed: name the final URL".formatted(status)
                : "it answers " + status;
        Duration retryAfter = status == 429 || status == 503
                ? response.headers()
                        .firstValue("Retry-After")
                        .map(this::duration)
                        .orElse(null)
                : null;
        return new Answer(Outcome.FAILED, reason, retryAfter);
    }

    /** Seconds, or a date; at most an hour. Null where it is neither. */
    private Duration duration(String retryAfter) {
        Duration time;
        if (retryAfter.matches("[0-9]{1,9}")) {
            time = Duration.ofSeconds(Long.parseLong(retryAfter));
        } else {
            try {
                Instant date = ZonedDateTime.parse(retryAfter, DateTimeFormatter.RFC_1123_DATE_TIME)
                        .toInstant();
                time = Duration.between(clock.instant(), date);
            } catch (DateTimeException e) {
                return null;
            }
        }
        return time.isNegative() ? Duration.ZERO : time.compareTo(MAX_RETRY_AFTER) > 0 ? MAX_RETRY_AFTER : time;
    }

    private static String reason(Throwable failure) {
        Throwable cause =
                failure instanceof CompletionException && failure.getCause() != null ? failure.getCause() : failure;
        return cause instanceof java.util.concurrent.CancellationException
                ? "no whole answer within %d s".formatted(TIMEOUT.toSeconds())
                : cause.toString();
    }

    private static byte[] body(String id, Alarm alarm) {
        try {
            ObjectNode json = NgsiJson.mapper().createObjectNode();
            json.put("id", id);
            json.setAll((ObjectNode) NgsiJson.read(alarm.toBytes()));
            return NgsiJson.write(json);
        } catch (UnreadableException e) {
            throw new IllegalStateException("an alarm is not read as it was written", e);
        }
    }
}
