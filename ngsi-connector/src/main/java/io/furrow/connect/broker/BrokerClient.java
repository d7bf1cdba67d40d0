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
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.regex.Pattern;

import io.furrow.model.text.FailureText;
import io.furrow.model.text.LogText;

/**
 * Sends requests to a context broker over persistent connections; never throws for failures of the network or the
 * broker. Thread-safe.
 */
public final class BrokerClient {
    /** A member of an error of NGSI-v2 or NGSI-LD. */
    private static final Pattern ERROR = Pattern.compile("^\\{.*\"(error|type|title)\"\\s*:", Pattern.DOTALL);

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
        if (!isOfBroker(status, answer.body())) {
            return new Outcome.WrongSetting(
                    uri + " answered " + words + ", which is not the answer of a context broker");
        }
        if (status / 100 == 2) {
            return new Outcome.Done(status, new ResponseHeaders(answer.headers()), answer.body());
        }
        return switch (status) {
            case 404 -> new Outcome.Absent(words);
            case 401, 403, 405 -> new Outcome.WrongSetting(uri + " answered " + words);
            case 408, 425, 429 -> away(uri, words, answer);
            default ->
                switch (status / 100) {
                    case 4 -> new Outcome.Rejected(status, words);
                    case 5 -> away(uri, words, answer);
                    default -> new Outcome.WrongSetting(uri + " answered " + words);
                };
        };
    }

    /** A proxy may answer 2xx with a page to log in, and 404 with its own page or JSON; a context broker names the error. */
    private static boolean isOfBroker(int status, byte[] body) {
        String text = new String(body, 0, Math.min(body.length, MAX_READ), StandardCharsets.UTF_8).strip();
        boolean isJson = text.isEmpty() || text.startsWith("{") || text.startsWith("[");
        return switch (status / 100) {
            case 2 -> isJson;
            case 4 -> status != 404 || text.isEmpty() || ERROR.matcher(text).find();
            default -> true;
        };
    }

    private static Outcome tooLarge(URI uri, LimitedBody.TooLargeException e) {
        return e.status() / 100 == 2
                ? new Outcome.Rejected(e.status(), e.status() + ", but " + e.getMessage())
                : away(uri + " answered " + e.status() + ", and " + e.getMessage(), e);
    }

    private static String text(byte[] body) {
        return LogText.beginning(new String(body, 0, Math.min(body.length, MAX_READ), StandardCharsets.UTF_8));
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
