package io.furrow.connect.source;

import java.io.UncheckedIOException;
import java.net.InetSocketAddress;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.LinkedBlockingQueue;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.connect.ledger.Ledger;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class NotificationServerTest {
    private static final int MAX_BODY = 100_000;
    private static final Duration ACK_TIMEOUT = Duration.ofMillis(300);
    private static final Duration PATIENCE = Duration.ofSeconds(15);

    /** Keeps what it is given until the test says that it is durable. */
    private static final class FakeIntake implements Intake {
        private final BlockingQueue<List<OutgoingRecord>> taken = new LinkedBlockingQueue<>();
        private volatile Optional<CompletableFuture<Void>> answer =
                Optional.of(CompletableFuture.completedFuture(null));

        @Override
        public Optional<CompletableFuture<Void>> take(List<OutgoingRecord> records) {
            taken.add(records);
            return answer;
        }
    }

    private final FakeIntake intake = new FakeIntake();
    private final HttpClient client = HttpClient.newHttpClient();
    private final Ledger ledger = new Ledger();
    private NotificationServer server;

    @BeforeEach
    void start() {
        server = listen(0, ACK_TIMEOUT);
    }

    @AfterEach
    void stop() {
        server.close();
    }

    @Test
    void answersOnlyWhenTheRecordsAreDurable() {
        server.close();
        server = listen(0, PATIENCE);
        CompletableFuture<Void> durable = new CompletableFuture<>();
        intake.answer = Optional.of(durable);

        CompletableFuture<HttpResponse<String>> answer = post("/any/path", BodyPublishers.ofString("{\"id\": \"a\"}"));
        await().until(() -> intake.taken.size() == 1);
        assertThat(answer).isNotDone();
        durable.complete(null);

        assertThat(answer.join().statusCode()).isEqualTo(200);
        assertThat(answer.join().body()).isEmpty();
    }

    @Test
    void answersUnavailableWhenTheyDoNotBecomeDurableInTime() {
        intake.answer = Optional.of(new CompletableFuture<>());

        HttpResponse<String> answer =
                post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join();

        assertThat(answer.statusCode()).isEqualTo(503);
        assertThat(answer.body()).contains("\"error\":\"unconfirmed\"");
        assertThat(ledger.late.sum()).isEqualTo(1);
    }

    @Test
    void answersUnavailableWhenThereIsNoRoom() {
        intake.answer = Optional.empty();

        HttpResponse<String> answer =
                post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join();

        assertThat(answer.statusCode()).isEqualTo(503);
        assertThat(answer.headers().firstValue("Retry-After")).contains("1");
        assertThat(ledger.overload.sum()).isEqualTo(1);
    }

    @Test
    void answersUnavailableWhenTheSourceStops() {
        intake.answer = Optional.of(CompletableFuture.failedFuture(new Intake.ClosedException()));

        assertThat(post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join().statusCode())
                .isEqualTo(503);
    }

    @Test
    void refusesWhatIsNoJsonWithAReason() {
        HttpResponse<String> answer =
                post("/", BodyPublishers.ofString("<xml/>")).join();

        assertThat(answer.statusCode()).isEqualTo(400);
        assertThat(answer.headers().firstValue("Content-Type")).contains("application/json");
        assertThat(answer.body()).startsWith("{\"error\":\"not-json\",\"description\":\"");
        assertThat(intake.taken.remove().get(0).value()).isEqualTo("<xml/>".getBytes());
    }

    @Test
    void refusesATooLargeBodyAndKeepsItsBeginning() {
        HttpResponse<String> answer =
                post("/", BodyPublishers.ofByteArray(new byte[3 * MAX_BODY])).join();

        assertThat(answer.statusCode()).isEqualTo(413);
        assertThat(intake.taken.remove().get(0).value()).hasSize(MAX_BODY);
        assertThat(post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join().statusCode())
                .isEqualTo(200);
    }

    @Test
    void takesABodyOfExactlyTheLimit() {
        String frame = "{\"id\": \"a\", \"x\": \"\"}";
        String body = frame.replace("\"\"", "\"" + "x".repeat(MAX_BODY - frame.length()) + "\"");

        assertThat(post("/", BodyPublishers.ofString(body)).join().statusCode()).isEqualTo(200);
        assertThat(post("/", BodyPublishers.ofString(body + " ")).join().statusCode())
                .isEqualTo(413);
    }

    @Test
    void hasNoRoomForMoreBodiesThanItsMemoryAllows() {
        server.close();
        server = listen(0, PATIENCE);
        CompletableFuture<Void> durable = new CompletableFuture<>();
        intake.answer = Optional.of(durable);
        byte[] half = new byte[MAX_BODY];
        List<CompletableFuture<HttpResponse<String>>> waiting =
                List.of(post("/", BodyPublishers.ofByteArray(half)), post("/", BodyPublishers.ofByteArray(half)));
        await().until(() -> intake.taken.size() == 2);

        assertThat(post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join().statusCode())
                .isEqualTo(503);
        durable.complete(null);

        assertThat(waiting)
                .allSatisfy(answer -> assertThat(answer.join().statusCode()).isEqualTo(400));
        assertThat(post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join().statusCode())
                .isEqualTo(200);
    }

    @Test
    void takesPostOnly() {
        HttpRequest put = HttpRequest.newBuilder(uri("/notify"))
                .PUT(BodyPublishers.ofString("{\"id\": \"a\"}"))
                .build();

        HttpResponse<String> answer = send(put).join();

        assertThat(answer.statusCode()).isEqualTo(405);
        assertThat(answer.headers().firstValue("Allow")).contains("POST");
        assertThat(intake.taken).isEmpty();
    }

    @Test
    void showsItsHealth() {
        HttpResponse<String> answer =
                send(HttpRequest.newBuilder(uri("/health")).build()).join();

        assertThat(answer.statusCode()).isEqualTo(200);
        assertThat(answer.body()).isEqualTo("{\"well\":true}");
    }

    @Test
    void freesItsPortWhenItCloses() {
        int port = server.port();
        assertThat(post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join().statusCode())
                .isEqualTo(200);

        server.close();
        server.close();
        server = listen(port, ACK_TIMEOUT);

        assertThat(server.port()).isEqualTo(port);
        assertThat(post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join().statusCode())
                .isEqualTo(200);
    }

    @Test
    void saysWhichAddressIsTaken() {
        int port = server.port();

        assertThatThrownBy(() -> listen(port, ACK_TIMEOUT))
                .isInstanceOf(UncheckedIOException.class)
                .hasMessageContaining("127.0.0.1:" + port);
    }

    @Test
    void waitsForAPredecessorThatIsAboutToFreeThePort() {
        NotificationServer predecessor = server;
        int port = server.port();
        CompletableFuture<NotificationServer> successor =
                CompletableFuture.supplyAsync(() -> listen(port, ACK_TIMEOUT, PATIENCE));
        assertThat(successor).isNotDone();

        predecessor.close();
        server = successor.join();

        assertThat(post("/", BodyPublishers.ofString("{\"id\": \"a\"}")).join().statusCode())
                .isEqualTo(200);
    }

    private NotificationServer listen(int port, Duration ackTimeout) {
        return listen(port, ackTimeout, Duration.ZERO);
    }

    private NotificationServer listen(int port, Duration ackTimeout, Duration patience) {
        NotificationTranslator translator = new NotificationTranslator(
                new NgsiSourceConfig(java.util.Map.of("journal.dir", "/tmp/journal")).translation(), ledger);
        NotificationHandler handler = new NotificationHandler(
                translator,
                intake,
                ledger,
                new NotificationHandler.Limits(MAX_BODY, new ByteBudget(2 * MAX_BODY), ackTimeout),
                () -> "{\"well\":true}".getBytes());
        return NotificationServer.start(
                new InetSocketAddress("127.0.0.1", port), handler, Duration.ofSeconds(30), patience);
    }

    private URI uri(String path) {
        return URI.create("http://127.0.0.1:" + server.port() + path);
    }

    private CompletableFuture<HttpResponse<String>> post(String path, HttpRequest.BodyPublisher body) {
        return send(
                HttpRequest.newBuilder(uri(path)).timeout(PATIENCE).POST(body).build());
    }

    private CompletableFuture<HttpResponse<String>> send(HttpRequest request) {
        return client.sendAsync(request, HttpResponse.BodyHandlers.ofString());
    }
}
