package io.furrow.control.alarm.action;

import java.io.IOException;
import java.io.OutputStream;
import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.time.ZoneOffset;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.Headers;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.Cause;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.stub.StubServer;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class WebhookTest {
    private static final long NOW = 1_700_000_000_000L;

    private final List<byte[]> posted = Collections.synchronizedList(new ArrayList<>());
    private final List<Headers> headers = Collections.synchronizedList(new ArrayList<>());
    private int status = 204;
    private String type = "text/plain";
    private String body = "";
    private String retryAfter;
    private boolean endless;
    private final CountDownLatch cut = new CountDownLatch(1);

    @AutoClose
    private final StubServer server = new StubServer(exchange -> {
        posted.add(exchange.getRequestBody().readAllBytes());
        headers.add(exchange.getRequestHeaders());
        if (retryAfter != null) {
            exchange.getResponseHeaders().add("Retry-After", retryAfter);
        }
        exchange.getResponseHeaders().add("Location", "/elsewhere");
        exchange.getResponseHeaders().add("Content-Type", type);
        byte[] bytes = body.getBytes(StandardCharsets.UTF_8);
        exchange.sendResponseHeaders(status, endless ? 0 : bytes.length == 0 ? -1 : bytes.length);
        exchange.getResponseBody().write(bytes);
        if (endless) {
            writeUntilItIsCut(exchange.getResponseBody());
        }
        exchange.close();
    });

    private void writeUntilItIsCut(OutputStream body) {
        try {
            while (true) {
                body.write(new byte[1024]);
            }
        } catch (IOException e) {
            cut.countDown();
        }
    }

    @Test
    void postsAnAlarmWithTheIdOfItsDelivery() throws Exception {
        assertThat(post(settings()).outcome()).isEqualTo(Webhook.Outcome.ACCEPTED);
        JsonNode body = NgsiJson.read(posted.get(0));
        assertThat(body.path("id").asText()).isEqualTo("collision-7:7");
        assertThat(body.path("alarm").asText()).isEqualTo("collision-7");
        assertThat(body.path("state").asText()).isEqualTo("open");
        assertThat(headers.get(0).getFirst("Furrow-Delivery")).isEqualTo("collision-7:7");
        assertThat(headers.get(0).getFirst("Furrow-Signature")).isNull();
    }

    @Test
    void signsTheBodyIfThereIsASecret(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve("secret"), "a-secret-of-some-length\n");
        post(settings().signedWith(file));
        String signature = WebhookSecret.read(file).signature(NOW / 1000, posted.get(0));
        assertThat(headers.get(0).getFirst("Furrow-Signature")).isEqualTo(signature);
    }

    @Test
    void doesNotStartWithAnInvalidSecret(@TempDir Path directory) {
        assertThatThrownBy(() -> new Webhook(settings().signedWith(directory.resolve("nosuch")), Clock.systemUTC()))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("nosuch cannot be read");
    }

    @ParameterizedTest
    @CsvSource({
        "200, ACCEPTED", "202, ACCEPTED", "204, ACCEPTED", "301, FAILED", "307, FAILED", "400, REJECTED", "401, FAILED",
                "403, FAILED",
        "404, FAILED", "408, FAILED", "410, FAILED", "422, REJECTED", "425, FAILED", "429, FAILED", "500, FAILED",
                "503, FAILED"
    })
    void distinguishesTemporaryFromPermanentRejections(int answered, Webhook.Outcome outcome) throws Exception {
        status = answered;
        assertThat(post(settings()).outcome()).isEqualTo(outcome);
        assertThat(posted).as("redirects are not followed").hasSize(1);
    }

    @ParameterizedTest
    @CsvSource({
        "429, 30, PT30S", "503, 30, PT30S",
        "500, 30, ", "503, 999999, PT1H",
        "503, 'Tue, 14 Nov 2023 22:14:00 GMT', PT40S", "503, 'Tue, 14 Nov 2023 22:13:00 GMT', PT0S",
        "503, soon, ", "503, -1, "
    })
    void parsesRetryAfter(int answered, String header, Duration expected) throws Exception {
        status = answered;
        retryAfter = header;
        assertThat(post(settings()).retryAfter()).isEqualTo(expected);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "<html>log in</html>",
                "\r\n <!DOCTYPE HTML PUBLIC '-//W3C//DTD HTML 4.01//EN'>",
                "\uFEFF<!doctype html><title>log in</title>"
            })
    void postsAgainIfAWebPageAnswers(String page) throws Exception {
        status = 200;
        type = "text/html; charset=utf-8";
        body = page;
        assertThat(post(settings()))
                .returns(Webhook.Outcome.FAILED, Webhook.Answer::outcome)
                .satisfies(answer -> assertThat(answer.reason()).contains("200", "web page"));
    }

    @Test
    void postsAgainIfAWebPageRejectsTheCertificate() throws Exception {
        status = 400;
        type = "text/html";
        body = "<html><title>400 No required SSL certificate was sent</title></html>";
        assertThat(post(settings()).outcome()).isEqualTo(Webhook.Outcome.FAILED);
    }

    @ParameterizedTest
    @CsvSource({"text/html, ok", "text/html, ''", "text/html, <p>ok</p>", "text/plain, <html>ok</html>"})
    void acceptsOtherBodies(String answeredType, String answered) throws Exception {
        status = 200;
        type = answeredType;
        body = answered;
        assertThat(post(settings()).outcome()).isEqualTo(Webhook.Outcome.ACCEPTED);
    }

    @Test
    void limitsTheBytesReadOfAResponse() throws Exception {
        status = 200;
        endless = true;
        assertThat(post(settings()).outcome()).isEqualTo(Webhook.Outcome.ACCEPTED);
        assertThat(cut.await(1, TimeUnit.MINUTES)).isTrue();
    }

    @Test
    void reportsARefusedConnection() throws Exception {
        Webhook.Settings settings = settings();
        server.close();
        assertThat(post(settings))
                .returns(Webhook.Outcome.FAILED, Webhook.Answer::outcome)
                .satisfies(answer -> assertThat(answer.reason()).isEqualTo("connection refused"));
    }

    @ParameterizedTest
    @ValueSource(strings = {"hooks.example.com/x", "localhost:8080/x", "ftp://a/x", "http:/x", "/x"})
    void rejectsAnInvalidUrl(String url) {
        assertThatThrownBy(() -> Webhook.Settings.of(URI.create(url)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining(url);
    }

    private Webhook.Settings settings() {
        return Webhook.Settings.of(server.uri("/hook"));
    }

    private static Webhook.Answer post(Webhook.Settings settings) throws Exception {
        Webhook webhook = new Webhook(settings, Clock.fixed(Instant.ofEpochMilli(NOW), ZoneOffset.UTC));
        Cause cause = new Cause(AlarmKind.COLLISION, "a-b", "close", List.of(), null);
        return webhook.post("collision-7:7", Alarm.raised(cause, null, 7, NOW)).get(1, TimeUnit.MINUTES);
    }
}
