package io.furrow.connect.broker;

import java.io.IOException;
import java.io.InputStream;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.ZoneOffset;
import java.time.ZonedDateTime;
import java.time.format.DateTimeFormatter;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import com.sun.net.httpserver.HttpHandler;
import org.apache.kafka.common.config.types.Password;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class BrokerClientTest {
    private static final FiwareScope PLOT = FiwareScope.of("agri", "/plot1");

    private volatile HttpHandler answering = exchange -> exchange.sendResponseHeaders(204, -1);

    @AutoClose
    private final StubServer server = new StubServer(exchange -> answering.handle(exchange));

    @Test
    void sendsScopeTokenAndBodyAndGivesTheAnswerAsJson() throws UnreadableException {
        CompletableFuture<String> asked = new CompletableFuture<>();
        answering = exchange -> {
            asked.complete(exchange.getRequestMethod() + " " + exchange.getRequestURI() + " "
                    + exchange.getRequestHeaders().getFirst("Fiware-Service")
                    + exchange.getRequestHeaders().getFirst("Fiware-Servicepath") + " "
                    + exchange.getRequestHeaders().getFirst("X-Auth-Token") + " "
                    + exchange.getRequestHeaders().getFirst("Content-Type") + " "
                    + new String(exchange.getRequestBody().readAllBytes(), UTF_8));
            exchange.getResponseHeaders().add("Fiware-Total-Count", "7");
            exchange.getResponseHeaders().add("Location", "/v2/subscriptions/51c0");
            StubServer.answer(exchange, 200, "[{\"id\":\"a\"}]");
        };

        Outcome outcome = client(Duration.ofSeconds(5))
                .send(BrokerRequest.patch(PLOT, "/v2/x?y=1", NgsiJson.mapper().createObjectNode()));

        assertThat(asked).isCompletedWithValue("PATCH /base/v2/x?y=1 agri/plot1 s3cret application/json {}");
        assertThat(outcome).isInstanceOfSatisfying(Outcome.Done.class, done -> {
            assertThat(done.headers().totalCount()).hasValue(7);
            assertThat(done.headers().createdId()).contains("51c0");
        });
        assertThat(((Outcome.Done) outcome).json().at("/0/id").textValue()).isEqualTo("a");
    }

    @Test
    void leavesTheDefaultTenantOut() {
        CompletableFuture<Boolean> named = new CompletableFuture<>();
        answering = exchange -> {
            named.complete(exchange.getRequestHeaders().containsKey("Fiware-Service"));
            StubServer.answer(exchange, 200, "");
        };

        assertThat(client(Duration.ofSeconds(5)).send(BrokerRequest.get(FiwareScope.DEFAULT, "/v2/entities")))
                .isInstanceOf(Outcome.Done.class);
        assertThat(named).isCompletedWithValue(false);
    }

    @ParameterizedTest
    @ValueSource(ints = {400, 409, 413, 422})
    void callsOtherAnswersOf4xxARefusalInTheWordsOfTheBroker(int status) {
        assertThat(answered(status, "too odd")).isEqualTo(new Outcome.Rejected(status, status + " too odd"));
    }

    @Test
    void takesNoAnswerThatIsLargerThanAllowed() {
        answering = exchange -> StubServer.answer(exchange, 200, "[" + " ".repeat(99_998) + "]");
        BrokerRequest asked = BrokerRequest.get(PLOT, "/v2/entities");

        assertThat(new BrokerClient(settings(Duration.ofSeconds(5)).withMaxAnswerBytes(99_999)).send(asked))
                .isEqualTo(new Outcome.Rejected(200, "200, but the answer is larger than 99999 bytes"));
        assertThat(new BrokerClient(settings(Duration.ofSeconds(5)).withMaxAnswerBytes(100_000)).send(asked))
                .isInstanceOf(Outcome.Done.class);
    }

    @Test
    void tellsWhatIsNotThereFromWhatIsRefused() {
        assertThat(answered(404, "{\"error\": \"NotFound\"}"))
                .isEqualTo(new Outcome.Absent("404 {\"error\": \"NotFound\"}"));
        assertThat(answered(404, "{\"title\": \"no entity\"}")).isInstanceOf(Outcome.Absent.class);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "200 | <html>log in</html>",
                "404 | <html>nginx</html>",
                "404 | not found",
                "404 | {\"message\": \"no Route\"}",
                "404 | ''",
                "404 | {\"timestamp\": 1, \"status\": 404, \"error\": \"Not Found\", \"path\": \"/v2/op/update\"}",
                "404 | {\"timestamp\": 1, \"status\": 404, \"title\": \"Not Found\", \"path\": \"/v2/op/update\"}",
                "404 | {\"error\": {\"code\": \"NOT_FOUND\", \"message\": \"The requested URL was not found\"}}",
                "404 | {\"type\": \"https://tools.ietf.org/html/rfc9110#section-15.5.5\", \"title\": \"Not Found\"}",
                "404 | {\"type\": \"about:blank\", \"title\": \"Not Found\", \"instance\": \"/v2/op/update\"}",
                "400 | <html><head><title>400 The SSL certificate error</title></head></html>",
                "406 | <html>Not Acceptable!</html>",
                "409 | <!DOCTYPE html><p>log in</p>"
            })
    void callsThePageOfAProxyAWrongSetting(int status, String page) {
        assertThat(answered(status, page))
                .isInstanceOfSatisfying(
                        Outcome.WrongSetting.class,
                        wrong -> assertThat(wrong.words())
                                .contains(url() + "/v2/x answered " + status, "context broker"));
    }

    @ParameterizedTest
    @ValueSource(ints = {301, 401, 402, 403, 405, 407, 410, 421, 423, 451})
    void callsAnAnswerThatNoRepetitionHelpsAWrongSetting(int status) {
        assertThat(answered(status, "no"))
                .isInstanceOfSatisfying(
                        Outcome.WrongSetting.class,
                        wrong -> assertThat(wrong.words()).contains(url() + "/v2/x answered " + status + " no"));
    }

    @ParameterizedTest
    @ValueSource(ints = {408, 425, 429, 500, 503})
    void callsABrokerAwayThatSaysToComeAgain(int status) {
        assertThat(answered(status, "later"))
                .isInstanceOfSatisfying(
                        Outcome.Unavailable.class,
                        unavailable -> assertThat(unavailable.retryAfter()).isEmpty());
        assertThat(answered(status, "<html>later</html>")).isInstanceOf(Outcome.Unavailable.class);
    }

    @Test
    void readsRetryAfterAsSecondsAndAsDate() {
        answering = exchange -> {
            String value = exchange.getRequestURI().getPath().endsWith("date")
                    ? ZonedDateTime.now(ZoneOffset.UTC).plusMinutes(5).format(DateTimeFormatter.RFC_1123_DATE_TIME)
                    : exchange.getRequestURI().getPath().endsWith("odd") ? "soon" : "7";
            exchange.getResponseHeaders().add("Retry-After", value);
            StubServer.answer(exchange, 429, "");
        };

        assertThat(retryAfter("/seconds")).contains(Duration.ofSeconds(7));
        assertThat(retryAfter("/date"))
                .hasValueSatisfying(wait -> assertThat(wait).isBetween(Duration.ofMinutes(4), Duration.ofMinutes(6)));
        assertThat(retryAfter("/odd")).isEmpty();
    }

    @Test
    @Timeout(60)
    void givesUpOnAnAnswerThatNeverEnds() {
        answering = exchange -> {
            exchange.sendResponseHeaders(200, 1000);
            exchange.getResponseBody().write('[');
            exchange.getResponseBody().flush();
        };

        assertThat(client(Duration.ofMillis(300)).send(BrokerRequest.get(PLOT, "/v2/x")))
                .isInstanceOfSatisfying(
                        Outcome.Unavailable.class,
                        unavailable -> assertThat(unavailable.reason()).contains("does not answer within 300 ms"));
    }

    @Test
    void namesTheAddressWhereNobodyListens() {
        server.close();

        assertThat(client(Duration.ofSeconds(5)).send(BrokerRequest.get(PLOT, "/v2/x")))
                .isInstanceOfSatisfying(
                        Outcome.Unavailable.class,
                        unavailable -> assertThat(unavailable.reason()).contains(url() + "/v2/x does not answer"));
    }

    @Test
    void keepsAnInterruptSet() {
        Thread.currentThread().interrupt();

        assertThat(client(Duration.ofSeconds(5)).send(BrokerRequest.get(PLOT, "/v2/x")))
                .isInstanceOf(Outcome.Unavailable.class);
        assertThat(Thread.interrupted()).isTrue();
    }

    @Test
    void sendsAgainWhatMayBeRepeatedWhenAKeptConnectionProvesDeadAndNothingElse() throws Exception {
        try (ServerSocket socket = new ServerSocket(0, 10, InetAddress.getLoopbackAddress())) {
            URI base = URI.create("http://127.0.0.1:" + socket.getLocalPort());
            BrokerClient client = new BrokerClient(BrokerSettings.of(base, Duration.ofSeconds(5)));

            CompletableFuture<Void> served = hangUpThenAnswer(socket);
            assertThat(client.send(BrokerRequest.post(PLOT, "/v2/op/update", new byte[0])))
                    .isInstanceOf(Outcome.Done.class);
            served.join();

            served = hangUpThenAnswer(socket);
            assertThat(client.send(BrokerRequest.create(
                            PLOT, "/v2/subscriptions", NgsiJson.mapper().createObjectNode())))
                    .isInstanceOf(Outcome.Unavailable.class);
            new Socket(socket.getInetAddress(), socket.getLocalPort()).close();
            served.join();
        }
    }

    @Test
    void sendsTheTokenThatTheFileHoldsAtTheTime(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve("token"), "first");
        CompletableFuture<String> token = new CompletableFuture<>();
        answering = exchange -> {
            token.complete(exchange.getRequestHeaders().getFirst("X-Auth-Token"));
            StubServer.answer(exchange, 200, "[]");
        };
        BrokerSettings settings = BrokerSettings.of(URI.create(url()), Duration.ofSeconds(5))
                .withToken(AccessToken.of(file, null, said -> {}));

        new BrokerClient(settings).send(BrokerRequest.get(PLOT, "/v2/entities"));

        assertThat(token).isCompletedWithValue("first");
    }

    @Test
    void keepsTheTokenToItself() {
        BrokerSettings settings = settings(Duration.ofSeconds(5));

        assertThat(settings.toString()).doesNotContain("s3cret");
        assertThat(answered(401, "who are you?").toString()).doesNotContain("s3cret");
    }

    private static CompletableFuture<Void> hangUpThenAnswer(ServerSocket socket) {
        return CompletableFuture.runAsync(() -> {
            try {
                try (Socket first = socket.accept()) {
                    assertThat(first.getInputStream().read()).isPositive();
                }
                try (Socket second = socket.accept();
                        InputStream in = second.getInputStream()) {
                    if (in.read() > 0) {
                        second.getOutputStream().write("HTTP/1.1 204 No Content\r\n\r\n".getBytes());
                    }
                }
            } catch (IOException e) {
                throw new java.io.UncheckedIOException(e);
            }
        });
    }

    private Optional<Duration> retryAfter(String path) {
        return ((Outcome.Unavailable) client(Duration.ofSeconds(5)).send(BrokerRequest.get(PLOT, path))).retryAfter();
    }

    private Outcome answered(int status, String body) {
        answering = exchange -> StubServer.answer(exchange, status, body);
        return client(Duration.ofSeconds(5)).send(BrokerRequest.get(PLOT, "/v2/x"));
    }

    private BrokerClient client(Duration timeout) {
        return new BrokerClient(settings(timeout));
    }

    private BrokerSettings settings(Duration timeout) {
        return new BrokerSettings(
                URI.create(url() + "/"), timeout, Map.of("X-Auth-Token", new Password("s3cret")), Optional.empty());
    }

    private String url() {
        return server.uri("/base").toString();
    }
}
