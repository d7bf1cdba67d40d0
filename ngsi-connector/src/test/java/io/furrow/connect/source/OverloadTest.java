package io.furrow.connect.source;

import java.io.IOException;
import java.io.OutputStream;
import java.net.Socket;
import java.net.SocketException;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.stream.IntStream;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.connect.source.journal.RecordLog;
import io.furrow.process.Ports;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class OverloadTest {
    private static final String ENTITY = "{\"id\": \"a\"}";

    @Test
    void resetsTheConnectionWhenThereIsNoRoomInTime() {
        try (NotificationRig rig = new NotificationRig("overload.hold.ms", "200")) {
            rig.recordLog.answer = Optional.empty();

            assertThatThrownBy(() -> rig.post(ENTITY).join()).hasCauseInstanceOf(IOException.class);

            assertThat(rig.ledger.overload.sum()).isEqualTo(1);
            assertThat(rig.ledger.delayed.sum()).isEqualTo(1);
            assertThat(rig.ledger.rejectedUnavailable.sum()).isEqualTo(1);
            assertThat(rig.ledger.late.sum()).isZero();
        }
    }

    @Test
    void resetsTheConnectionWhenTheRecordsAreNotDurableInTime() {
        try (NotificationRig rig = new NotificationRig("overload.hold.ms", "200")) {
            CompletableFuture<Void> durable = new CompletableFuture<>();
            rig.recordLog.answer = Optional.of(durable);

            assertThatThrownBy(() -> rig.post(ENTITY).join()).hasCauseInstanceOf(IOException.class);

            assertThat(rig.ledger.late.sum()).isEqualTo(1);
            assertThat(rig.ledger.rejectedUnavailable.sum()).isZero();
            durable.completeExceptionally(new RecordLog.ClosedException());
            assertThat(rig.ledger.rejectedUnavailable.sum()).isEqualTo(1);
        }
    }

    @Test
    void countsTheHoldFromTheEndOfTheBody() throws IOException {
        try (NotificationRig rig = new NotificationRig("overload.hold.ms", "2000");
                Socket slow = new Socket("127.0.0.1", rig.port())) {
            slow.setSoTimeout((int) NotificationRig.TIMEOUT.toMillis());
            slow.getOutputStream()
                    .write("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 11\r\n\r\n{".getBytes());
            // The rest takes longer than the sender may be held, and the records then take a moment.
            await().pollDelay(Duration.ofMillis(2500)).until(() -> true);
            CompletableFuture<Void> durable = new CompletableFuture<>();
            rig.recordLog.answer = Optional.of(durable);

            slow.getOutputStream().write("\"id\": \"a\"}".getBytes());
            await().until(() -> rig.recordLog.taken.size() == 1);
            durable.complete(null);

            byte[] status = slow.getInputStream().readNBytes("HTTP/1.1 200".length());
            assertThat(new String(status, US_ASCII)).isEqualTo("HTTP/1.1 200");
            assertThat(rig.ledger.overload.sum()).isZero();
        }
    }

    @Test
    void answersUnavailableWhereThatIsDesired() {
        try (NotificationRig rig = new NotificationRig("overload.hold.ms", "200", "overload.answer", "503")) {
            rig.recordLog.answer = Optional.empty();

            HttpResponse<String> answer = rig.post(ENTITY).join();

            assertThat(answer.statusCode()).isEqualTo(503);
            assertThat(answer.headers().firstValue("Retry-After")).contains("1");
            assertThat(answer.body()).contains("\"error\":\"unavailable\"");
            assertThat(rig.ledger.overload.sum()).isEqualTo(1);
        }
    }

    @Test
    void answersUnavailableWhenTheSourceStops() {
        try (NotificationRig rig = new NotificationRig("overload.answer", "503")) {
            rig.recordLog.answer = Optional.of(CompletableFuture.failedFuture(new RecordLog.ClosedException()));

            assertThat(rig.post(ENTITY).join().statusCode()).isEqualTo(503);
        }
    }

    @Test
    void resetsAConnectionThatSendsWhileTheSourceStops() throws Exception {
        NotificationRig rig = new NotificationRig();
        try (Socket kept = new Socket("127.0.0.1", rig.port())) {
            kept.setSoTimeout((int) NotificationRig.TIMEOUT.toMillis());
            // One request without an answer keeps the server from its end.
            rig.recordLog.answer = Optional.of(new CompletableFuture<>());
            CompletableFuture<HttpResponse<String>> pending = rig.post(ENTITY);
            await().until(() -> rig.recordLog.taken.size() == 1);
            int port = rig.port();
            kept.getOutputStream().write("POST / HTTP/1.1\r\nHost: localhost\r\nX: ".getBytes());

            CompletableFuture<Void> stopped = CompletableFuture.runAsync(rig::close);
            await().pollInterval(Duration.ofMillis(1)).until(() -> {
                kept.getOutputStream().write('x'); // one that says nothing is closed at once
                return !Ports.isListening(port);
            });

            assertThat(isAnswered(kept, "\r\nContent-Length: 10\r\n\r\n{\"id\":\"a\"}"))
                    .isFalse();
            assertThat(rig.recordLog.taken).hasSize(1);
            assertThat(stopped).succeedsWithin(NotificationRig.TIMEOUT);
            assertThat(pending).failsWithin(NotificationRig.TIMEOUT);
        }
    }

    /** A reset may meet the end of the request as well as the answer. */
    private static boolean isAnswered(Socket socket, String end) throws IOException {
        try {
            socket.getOutputStream().write(end.getBytes());
            return socket.getInputStream().read() >= 0;
        } catch (SocketException e) {
            return false; // reset
        }
    }

    @Test
    void takesWhatWaitedInItsOrderWhenThereIsRoomAgain() {
        try (NotificationRig rig = new NotificationRig()) {
            rig.recordLog.answer = Optional.empty();
            List<CompletableFuture<HttpResponse<String>>> answers = new ArrayList<>();
            for (int i = 0; i < 5; i++) {
                long before = rig.ledger.delayed.sum();
                answers.add(rig.post("{\"id\": \"" + i + "\"}"));
                await().until(() -> rig.ledger.delayed.sum() == before + 1);
            }

            rig.recordLog.answer = Optional.of(CompletableFuture.completedFuture(null));

            assertThat(answers)
                    .allSatisfy(answer -> assertThat(answer.join().statusCode()).isEqualTo(200));
            assertThat(rig.recordLog.taken)
                    .extracting(records -> records.get(0).key())
                    .containsExactly("0", "1", "2", "3", "4");
            assertThat(rig.ledger.overload.sum()).isZero();
        }
    }

    @Test
    void leavesBodiesInTheNetworkThatItHasNoMemoryFor() {
        try (NotificationRig rig = new NotificationRig(
                "max.body.bytes", "100000", "overload.memory.bytes", "200000", "overload.hold.ms", "9000")) {
            CompletableFuture<Void> durable = new CompletableFuture<>();
            rig.recordLog.answer = Optional.of(durable);
            byte[] half = new byte[100_000];
            List<CompletableFuture<HttpResponse<String>>> answers = IntStream.range(0, 6)
                    .mapToObj(i -> rig.post("/", BodyPublishers.ofByteArray(half)))
                    .toList();
            await().until(() -> rig.recordLog.taken.size() == 2);
            assertThat(rig.ledger.requests.sum()).isEqualTo(2);

            rig.recordLog.answer = Optional.of(CompletableFuture.completedFuture(null));
            durable.complete(null);

            assertThat(answers)
                    .allSatisfy(answer -> assertThat(answer.join().statusCode()).isEqualTo(400));
            assertThat(rig.recordLog.taken).hasSize(6);
        }
    }

    @Test
    void turnsAwayABodyThatFindsNoMemoryInTime() {
        try (NotificationRig rig = new NotificationRig(
                "max.body.bytes",
                "100000",
                "overload.memory.bytes",
                "100000",
                "overload.hold.ms",
                "300",
                "overload.answer",
                "503")) {
            rig.recordLog.answer = Optional.of(new CompletableFuture<>());
            byte[] all = new byte[100_000];

            List<CompletableFuture<HttpResponse<String>>> answers = IntStream.range(0, 3)
                    .mapToObj(i -> rig.post("/", BodyPublishers.ofByteArray(all)))
                    .toList();

            assertThat(answers)
                    .allSatisfy(answer -> assertThat(answer.join().statusCode()).isEqualTo(503));
            rig.recordLog.answer = Optional.of(CompletableFuture.completedFuture(null));
            assertThat(rig.post(ENTITY).join().statusCode()).isEqualTo(200);
        }
    }

    @Test
    void cutsASenderThatTricklesItsHeaders() throws IOException {
        try (NotificationRig rig = new NotificationRig("listen.request.timeout.ms", "400", "overload.hold.ms", "100");
                Socket slow = new Socket("127.0.0.1", rig.port())) {
            trickle(slow, "POST /v2/notify HTTP/1.1\r\nHost: localhost\r\nX: ");

            assertThat(rig.ledger.timedOut.sum()).isEqualTo(1);
        }
    }

    @Test
    void cutsASenderThatTricklesItsBody() throws IOException {
        try (NotificationRig rig = new NotificationRig("listen.request.timeout.ms", "400", "overload.hold.ms", "100");
                Socket slow = new Socket("127.0.0.1", rig.port())) {
            trickle(slow, "POST /v2/notify HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\n{");

            await().until(() -> rig.ledger.timedOut.sum() == 1);
            assertThat(rig.recordLog.taken).isEmpty();
        }
    }

    @Test
    void cutsASilentSender() throws IOException {
        try (NotificationRig rig = new NotificationRig("listen.idle.timeout.ms", "200");
                Socket silent = new Socket("127.0.0.1", rig.port())) {
            silent.getOutputStream()
                    .write("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\n{".getBytes());
            silent.setSoTimeout(60_000);

            String answer = new String(silent.getInputStream().readAllBytes(), US_ASCII);

            assertThat(answer).doesNotContain("200 OK");
            assertThat(rig.ledger.timedOut.sum()).isEqualTo(1);
        }
    }

    @Test
    void letsAConnectionBeIdleBetweenRequestsForLongerThanARequestMayTake() throws Exception {
        try (NotificationRig rig = new NotificationRig("listen.request.timeout.ms", "5000", "overload.hold.ms", "100");
                Socket kept = new Socket("127.0.0.1", rig.port())) {
            byte[] request =
                    "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\n{\"id\":\"a\"}".getBytes();
            kept.getOutputStream().write(request);
            await().until(() -> rig.recordLog.taken.size() == 1);

            await().pollDelay(Duration.ofMillis(5500)).until(() -> true);
            kept.getOutputStream().write(request);

            await().until(() -> rig.recordLog.taken.size() == 2);
            assertThat(rig.ledger.timedOut.sum()).isZero();
        }
    }

    @Test
    void letsFurtherConnectionsWaitUntilOneIsClosed() throws IOException {
        try (NotificationRig rig = new NotificationRig("listen.max.connections", "1");
                Socket second = new Socket()) {
            try (Socket first = new Socket("127.0.0.1", rig.port())) {
                first.getOutputStream().write(request("first"));
                await().until(() -> rig.recordLog.taken.size() == 1);
                second.connect(new java.net.InetSocketAddress("127.0.0.1", rig.port()));
                second.getOutputStream().write(request("second"));

                await().during(Duration.ofMillis(300)).until(() -> rig.recordLog.taken.size() == 1);
            }

            await().until(() -> rig.recordLog.taken.size() == 2);
        }
    }

    private static byte[] request(String id) {
        String body = "{\"id\": \"" + id + "\"}";
        return ("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + body.length() + "\r\n\r\n" + body)
                .getBytes();
    }

    /** Sends a byte every 50 ms until the connection is cut. */
    private static void trickle(Socket socket, String beginning) throws IOException {
        OutputStream out = socket.getOutputStream();
        out.write(beginning.getBytes(US_ASCII));
        await().pollInterval(Duration.ofMillis(50)).until(() -> {
            try {
                out.write('x');
                out.flush();
                return false;
            } catch (IOException e) {
                return true;
            }
        });
    }
}
