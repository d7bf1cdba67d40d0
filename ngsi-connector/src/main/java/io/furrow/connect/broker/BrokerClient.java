package io.furrow.connect.broker;

import java.io.IOException;
import java.net.ConnectException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublisher;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.time.ZonedDateTime;
import java.time.format.DateTimeFormatter;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.text.LogText;

/**
 * Sends requests to a context broker over persistent connections; never throws for failures of the network or the
 * broker. Thread-safe.
 */
public final class BrokerClient {
    /** The errors of NGSI-v2 with status 404. */
    private static final Set<String> ABSENCES = Set.of("NotFound", "NonExistingTenant");
    /** In the types of all errors of NGSI-LD. */
    private static final String ERRORS_OF_LD = "/ngsi-ld/errors/";

    private static final Pattern JSON = Pattern.compile("\\s*([{\\[]|$)");
    private static final Pattern PAGE = Pattern.compile("[\\s\\uFEFF]*<");

    /** Bytes of an error answer that are read for its message. */
    private static final int MAX_READ = 4000;

    private final HttpClient client;
    private final BrokerSettings settings;

    public BrokerClient(BrokerSettings settings) {
        this(http(settings), settings);
    }

    /** @param client that follows no redirects */
    BrokerClient(HttpClient client, BrokerSettings settings) {
        this.client = client;
        this.settings = settings;
    }

    private static HttpClient http(BrokerSettings settings) {
        HttpClient.Builder builder = HttpClient.newBuilder()
                .version(HttpClient.Version.HTTP_1_1)
                .followRedirects(HttpClient.Redirect.NEVER)
                .connectTimeout(settings.timeout());
        settings.tls().ifPresent(builder::sslContext);
        return builder.build();
    }

    /** Waits for the answer; an interrupt while waiting stays set and counts as {@link Outcome.Unavailable}. */
    public Outcome send(BrokerRequest asked) {
        URI uri = URI.create(settings.prefix() + asked.path());
        HttpRequest request = request(uri, asked);
        long deadline = System.nanoTime() + settings.timeout().toNanos();
        try {
            try {
                return outcome(uri, answer(request, deadline));
            } catch (LimitedBody.TooLargeException e) {
                return tooLarge(uri, e);
            } catch (IOException e) {
                if (!asked.repeatable() || e instanceof ConnectException) {
                    throw e;
                }
                return outcome(uri, answer(request, deadline));
            }
        } catch (LimitedBody.TooLargeException e) {
            return tooLarge(uri, e);
        } catch (IOException e) {
            return away(uri + " does not answer: " + FailureText.of(e), e);
        } catch (TimeoutException e) {
            return away(uri + " does not answer within " + settings.timeout().toMillis() + " ms", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return away("interrupted while waiting for " + uri, e);
        }
    }

    private HttpRequest request(URI uri, BrokerRequest asked) {
        BodyPublisher body = asked.body() == null ? BodyPublishers.noBody() : BodyPublishers.ofByteArray(asked.body());
        HttpRequest.Builder request = HttpRequest.newBuilder(uri)
                .method(asked.method(), body)
                .header("Fiware-Servicepath", asked.scope().servicePath());
        asked.headers().forEach(request::setHeader);
        if (!asked.scope().service().isEmpty()) {
            request.header("Fiware-Service", asked.scope().service());
        }
        settings.headers().forEach((name, value) -> request.setHeader(name, value.value()));
        settings.token().addTo(request::setHeader);
        return request.build();
    }

    /** The timeout of HttpClient ends with the headers of the answer; this one ends with its body. */
    private HttpResponse<byte[]> answer(HttpRequest request, long deadline)
            throws IOException, InterruptedException, TimeoutException {
        CompletableFuture<HttpResponse<byte[]>> answer =
                client.sendAsync(request, LimitedBody.of(settings.maxAnswerBytes()));
        try {
            return answer.get(Math.max(0, deadline - System.nanoTime()), TimeUnit.NANOSECONDS);
        } catch (ExecutionException e) {
            throw e.getCause() instanceof IOException io ? io : new IOException(e.getCause());
        } finally {
            answer.cancel(true);
        }
    }

    private static Outcome outcome(URI uri, HttpResponse<byte[]> answer) {
        int status = answer.statusCode();
        String words = status + " " + text(answer.body());
        Outcome wrong = new Outcome.WrongSetting(status, uri + " answered " + words);
        Outcome ofProxy = new Outcome.WrongSetting(
                status, uri + " answered " + words + ", which is not the answer of a context broker");
        return switch (status) {
            case 404 -> isAbsence(answer.body()) ? new Outcome.Absent(words) : ofProxy;
            case 401, 402, 403, 405, 407, 410, 421, 423, 451 -> wrong;
            case 408, 425, 429 -> away(uri, words, answer);
            // A smaller request may pass the proxy, too.
            case 413, 414, 431 -> new Outcome.Rejected(status, words);
            default ->
                switch (status / 100) {
                    case 2 ->
                        begins(JSON, answer.body())
                                ? new Outcome.Done(status, new ResponseHeaders(answer.headers()), answer.body())
                                : ofProxy;
                    case 4 -> begins(PAGE, answer.body()) ? ofProxy : new Outcome.Rejected(status, words);
                    case 5 -> away(uri, words, answer);
                    default -> wrong;
                };
        };
    }

    private static boolean begins(Pattern beginning, byte[] body) {
        return beginning.matcher(beginning(body)).lookingAt();
    }

    /** Whether a body is the error of a context broker; a proxy answers 404 with nothing, or a page or JSON of its own. */
    private static boolean isAbsence(byte[] body) {
        try {
            JsonNode json = NgsiJson.read(body);
            return ABSENCES.contains(json.path("error").asText()) || isProblemOfLd(json);
        } catch (UnreadableException e) {
            return false;
        }
    }

    /** Some versions of Scorpio have the status as type; an error of Spring has a path and a time. */
    private static boolean isProblemOfLd(JsonNode json) {
        JsonNode type = json.path("type");
        return type.isTextual()
                ? type.textValue().contains(ERRORS_OF_LD)
                : json.path("title").isTextual() && !json.has("path") && !json.has("timestamp");
    }

    private static Outcome tooLarge(URI uri, LimitedBody.TooLargeException e) {
        return e.status() / 100 == 2
                ? new Outcome.Rejected(e.status(), e.status() + ", but " + e.getMessage())
                : away(uri + " answered " + e.status() + ", and " + e.getMessage(), e);
    }

    private static String text(byte[] body) {
        return LogText.beginning(beginning(body));
    }

    private static String beginning(byte[] body) {
        return new String(body, 0, Math.min(body.length, MAX_READ), StandardCharsets.UTF_8);
    }

    private static Outcome away(String reason, Throwable cause) {
        return new Outcome.Unavailable(reason, Optional.empty(), cause, 0);
    }

    private static Outcome away(URI uri, String words, HttpResponse<byte[]> answer) {
        Optional<Duration> retryAfter =
                answer.headers().firstValue("Retry-After").flatMap(BrokerClient::retryAfter);
        return new Outcome.Unavailable(uri + " answered " + words, retryAfter, null, answer.statusCode());
    }

    /** RFC 9110: seconds, or a date. */
    private static Optional<Duration> retryAfter(String value) {
        try {
            if (value.matches("\\d{1,9}")) {
                return Optional.of(Duration.ofSeconds(Long.parseLong(value)));
            }
            Duration wait =
                    Duration.between(Instant.now(), ZonedDateTime.parse(value, DateTimeFormatter.RFC_1123_DATE_TIME));
            return Optional.of(wait.isNegative() ? Duration.ZERO : wait);
        } catch (DateTimeException e) {
            return Optional.empty();
        }
    }
}
