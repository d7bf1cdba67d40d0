package io.furrow.control.alarm.action;

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
import java.util.concurrent.CancellationException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.alarm.Alarm;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.text.FailureText;

/**
 * Posts alarms to a URL as JSON: the record of {@code service.alarms} with {@code id}, signed if there is a secret.
 * Redirects are not followed, and at most {@value BoundedBody#MAX_BYTES} bytes of a response are read.
 */
public final class Webhook {
    static final String SIGNATURE = "Furrow-Signature";
    static final String DELIVERY = "Furrow-Delivery";

    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final Duration MAX_RETRY_AFTER = Duration.ofHours(1);
    /** 4xx status codes that do not concern the alarm: an expired token, a proxy that does not find the receiver. */
    private static final Set<Integer> TEMPORARY =
            Set.of(401, 402, 403, 404, 405, 407, 408, 410, 421, 423, 425, 429, 451);

    private static final Pattern HTML = Pattern.compile("text/html\\b.*", Pattern.CASE_INSENSITIVE);
    private static final Pattern PAGE =
            Pattern.compile("[\\s\\uFEFF]*(<!doctype html|<html)", Pattern.CASE_INSENSITIVE);

    private final URI url;
    private final WebhookSecret secret;
    private final Clock clock;
    private final HttpClient client = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .followRedirects(HttpClient.Redirect.NEVER)
            .connectTimeout(TIMEOUT)
            .build();

    /**
     * Where and when to post. The URL may contain a secret, therefore only its host is logged.
     *
     * @param url absolute, http or https
     * @param secret file with the secret that signs the bodies; null for no signature
     * @param groupWait how long an alarm less severe than major waits for an inhibiting alarm
     * @param repeatInterval after how long an open alarm is posted again
     */
    public record Settings(URI url, Path secret, Duration groupWait, Duration repeatInterval) {
        /** @throws IllegalArgumentException if the URL is not an absolute http or https URL */
        public Settings {
            boolean http = "http".equalsIgnoreCase(url.getScheme()) || "https".equalsIgnoreCase(url.getScheme());
            if (!http || url.getHost() == null) {
                throw new IllegalArgumentException(
                        "the webhook's URL is not an absolute http or https URL with a host: " + url);
            }
        }

        /** Default settings: not signed, group wait of ten seconds, repeat interval of four hours. */
        public static Settings of(URI url) {
            return new Settings(url, null, Duration.ofSeconds(10), Duration.ofHours(4));
        }

        public Settings signedWith(Path file) {
            return new Settings(url, file, groupWait, repeatInterval);
        }

        /**
         * Checks the secret and returns the same settings.
         *
         * @throws IOException if the secret cannot be used; the
         * message says why and what to do
         */
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

    /** Result of a post. */
    enum Outcome {
        ACCEPTED,
        /** Rejected permanently. */
        REJECTED,
        /** May be accepted later. */
        FAILED
    }

    /**
     * @param reason null if accepted
     * @param retryAfter how long not to post; null if not given
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
     * Posts an alarm once. The future completes normally, even if no response arrives in time.
     *
     * @param id of the delivery, the same for every attempt
     */
    CompletableFuture<Answer> post(String id, Alarm alarm) {
        HttpRequest request = request(id, body(id, alarm));
        CompletableFuture<HttpResponse<String>> sent = client.sendAsync(request, BoundedBody::beginning);
        // The request's own timeout covers only the headers; a body could take forever.
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

    private Answer answer(HttpResponse<String> response) {
        int status = response.statusCode();
        if (status / 100 == 2) {
            return isPage(response)
                    ? Answer.failed("it responded with %d and a web page, as to log in: name the URL of the receiver"
                            .formatted(status))
                    : new Answer(Outcome.ACCEPTED, null, null);
        }
        if (status / 100 == 4 && !TEMPORARY.contains(status) && !isPage(response)) {
            return new Answer(Outcome.REJECTED, "it responded with " + status, null);
        }
        String reason = status / 100 == 3
                ? "it responded with %d, and redirects are not followed: name the final URL".formatted(status)
                : "it responded with " + status;
        Duration retryAfter = status == 429 || status == 503
                ? response.headers()
                        .firstValue("Retry-After")
                        .map(this::duration)
                        .orElse(null)
                : null;
        return new Answer(Outcome.FAILED, reason, retryAfter);
    }

    private static boolean isPage(HttpResponse<String> response) {
        String type = response.headers().firstValue("Content-Type").orElse("");
        return HTML.matcher(type).matches() && PAGE.matcher(response.body()).lookingAt();
    }

    /** Parses seconds or a date; at most an hour. Null if it is neither. */
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
        Throwable cause = FailureText.unwrap(failure);
        return cause instanceof CancellationException
                ? "no complete response within %d s".formatted(TIMEOUT.toSeconds())
                : FailureText.of(cause);
    }

    private static byte[] body(String id, Alarm alarm) {
        ObjectNode json = NgsiJson.object().put("id", id);
        return NgsiJson.write(json.setAll(StateJson.tree(alarm)));
    }
}
