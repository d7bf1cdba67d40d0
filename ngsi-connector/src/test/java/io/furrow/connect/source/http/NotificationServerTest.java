package io.furrow.connect.source.http;

import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import org.apache.kafka.connect.errors.ConnectException;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.NotificationEndpoint;
import io.furrow.connect.source.NotificationRig;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class NotificationServerTest {
    private static final int MAX_BODY = 100_000;

    @AutoClose
    private final NotificationRig rig = new NotificationRig("max.body.bytes", Integer.toString(MAX_BODY));

    @Test
    void answersOnlyWhenTheRecordsAreDurable() {
        CompletableFuture<Void> durable = new CompletableFuture<>();
        rig.recordLog.answer = Optional.of(durable);

        CompletableFuture<HttpResponse<String>> answer =
                rig.post("/any/path", BodyPublishers.ofString("{\"id\": \"a\"}"));
        await().until(() -> rig.recordLog.taken.size() == 1);
        assertThat(answer).isNotDone();
        durable.complete(null);

        assertThat(answer.join().statusCode()).isEqualTo(200);
        assertThat(answer.join().body()).isEmpty();
    }

    @Test
    void refusesWhatIsNoJsonWithAReasonAndKeepsItsBytes() {
        HttpResponse<String> answer = rig.post("<xml/>").join();

        assertThat(answer.statusCode()).isEqualTo(400);
        assertThat(answer.headers().firstValue("Content-Type")).contains("application/json");
        assertThat(answer.body()).startsWith("{\"error\":\"not-json\",\"description\":\"");
        KafkaRecord dead = rig.recordLog.taken.remove().get(0);
        assertThat(dead.topic()).isEqualTo("data.raw.dead");
        assertThat(dead.value()).isEqualTo("<xml/>".getBytes());
    }

    @Test
    void refusesATooLargeBodyAndKeepsItsBeginning() {
        HttpResponse<String> answer = rig.post("/", BodyPublishers.ofByteArray(new byte[3 * MAX_BODY]))
                .join();

        assertThat(answer.statusCode()).isEqualTo(413);
        assertThat(rig.recordLog.taken.remove().get(0).value()).hasSize(MAX_BODY);
        assertThat(rig.post("{\"id\": \"a\"}").join().statusCode()).isEqualTo(200);
    }

    @Test
    void takesABodyOfExactlyTheLimit() {
        String frame = "{\"id\": \"a\", \"x\": \"\"}";
        String body = frame.replace("\"\"", "\"" + "x".repeat(MAX_BODY - frame.length()) + "\"");

        assertThat(rig.post(body).join().statusCode()).isEqualTo(200);
        assertThat(rig.post(body + " ").join().statusCode()).isEqualTo(413);
    }

    @Test
    void takesABodyOfUnknownLength() {
        byte[] body = ("{\"id\": \"a\", \"x\": \"" + "x".repeat(50_000) + "\"}").getBytes();

        HttpResponse<String> answer = rig.post(
                        "/", BodyPublishers.ofInputStream(() -> new java.io.ByteArrayInputStream(body)))
                .join();

        assertThat(answer.statusCode()).isEqualTo(200);
    }

    @Test
    void takesPostOnly() {
        HttpRequest put = HttpRequest.newBuilder(rig.uri("/v2/notify"))
                .PUT(BodyPublishers.ofString("{\"id\": \"a\"}"))
                .build();

        HttpResponse<String> answer = rig.send(put).join();

        assertThat(answer.statusCode()).isEqualTo(405);
        assertThat(answer.headers().firstValue("Allow")).contains("GET, HEAD, POST");
        assertThat(rig.recordLog.taken).isEmpty();
    }

    @Test
    void refusesHeadersThatAreTooLarge() {
        assertThat(rig.post("/", BodyPublishers.ofString("{\"id\": \"a\"}"), "X", "y".repeat(20_000))
                        .join()
                        .statusCode())
                .isEqualTo(431);
    }

    @Test
    void readsTheTenantOfNgsiLd() {
        rig.post("/", BodyPublishers.ofString("{\"id\": \"a\"}"), "NGSILD-Tenant", "Farm")
                .join();

        assertThat(rig.recordLog.taken.remove().get(0).headers()).containsEntry("fiware-service", "farm");
    }

    @Test
    void showsItsHealth() {
        rig.post("{\"id\": \"a\"}").join();

        HttpResponse<String> answer = rig.get("/health").join();

        assertThat(answer.statusCode()).isEqualTo(200);
        assertThat(answer.body()).contains("\"received\":1", "\"accepted\":1");
    }

    @Test
    void showsItsNumbersToPrometheus() {
        rig.post("{\"id\": \"a\"}").join();

        HttpResponse<String> answer = rig.get("/metrics").join();

        assertThat(answer.headers().firstValue("Content-Type")).contains("text/plain; version=0.0.4; charset=utf-8");
        assertThat(answer.body())
                .contains("furrow_ngsi_source_accepted_total{connector=\"ngsi-source\",task=\"0\"} 1.0\n");
    }

    @Test
    void freesItsPortWhenItCloses() {
        assertThat(rig.post("{\"id\": \"a\"}").join().statusCode()).isEqualTo(200);
        int port = rig.port();

        rig.replace();

        assertThat(rig.port()).isEqualTo(port);
        assertThat(rig.post("{\"id\": \"a\"}").join().statusCode()).isEqualTo(200);
    }

    @Test
    void saysWhichAddressIsTakenAndWhichOptionsNameIt() {
        assertThatThrownBy(() -> rig.open(rig.port(), java.time.Duration.ZERO))
                .isInstanceOf(ConnectException.class)
                .hasMessageContainingAll("127.0.0.1:" + rig.port(), "listen.port");
    }

    @Test
    void waitsForAPredecessorThatIsAboutToFreeThePort() {
        int port = rig.port();
        CompletableFuture<NotificationEndpoint> successor = CompletableFuture.supplyAsync(() -> rig.open(port));
        assertThat(successor).isNotDone();

        rig.close();

        try (NotificationEndpoint listening = successor.join()) {
            assertThat(listening.port()).isEqualTo(port);
        }
    }
}
