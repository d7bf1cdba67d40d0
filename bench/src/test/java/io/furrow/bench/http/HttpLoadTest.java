package io.furrow.bench.http;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.time.Duration;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;

class HttpLoadTest {
    private static final int BODY = 500;

    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void countsEachAnsweredNotificationUnderItsNumber(boolean newConnections) {
        try (BaselineServer server = BaselineServer.start()) {
            HttpLoad load = new HttpLoad(server.address(), plan(8, newConnections, 0, 500), 5_000);
            HttpLoad.Result result = load.run();

            assertThat(result.answered()).isGreaterThan(100).isEqualTo(load.sent());
            assertThat(result.acknowledged().cardinality()).isEqualTo((int) load.sent());
            assertThat(result.acknowledged().nextClearBit(0)).isEqualTo((int) load.sent());
            assertThat(result.refused() + result.broken()).isZero();
            assertThat(result.firstNumber()).isEqualTo(5_000);
        }
    }

    @Tag("full")
    @Test
    void sendsWhatIsDueAndNoMore() {
        try (BaselineServer server = BaselineServer.start()) {
            HttpLoad.Result result = new HttpLoad(server.address(), plan(8, false, 200, 1000), 0).run();

            assertThat(result.answered()).isEqualTo(200);
        }
    }

    @Test
    void countsTheDelayFromWhenARequestWasDueThoughItCouldNotBeSent() throws IOException {
        try (ServerSocket listening = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            CompletableFuture.runAsync(() -> serve(listening, 200, Duration.ofMillis(800)));

            HttpLoad.Result result = new HttpLoad(address(listening), plan(1, false, 100, 1000), 0).run();

            assertThat(result.answered()).isEqualTo(100);
            // 80 were due while the one connection waited, the k-th of them for 800 - 10 k ms: half of all for over 300
            assertThat(result.millis(50)).isGreaterThan(250);
            assertThat(result.millis(99)).isGreaterThan(700);
        }
    }

    @Test
    void countsAnswersThatAreNo2xxAsRefused() throws IOException {
        try (ServerSocket listening = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            CompletableFuture.runAsync(() -> serve(listening, 503, Duration.ZERO));

            HttpLoad.Result result = new HttpLoad(address(listening), plan(1, false, 100, 200), 0).run();

            assertThat(result.refused()).isEqualTo(20);
            assertThat(result.answered()).isZero();
            assertThat(result.acknowledged().isEmpty()).isTrue();
        }
    }

    @Test
    void countsRequestsWithoutAConnectionAsBroken() throws IOException {
        InetSocketAddress nobody;
        try (ServerSocket closedAtOnce = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            nobody = address(closedAtOnce);
        }
        HttpLoad load = new HttpLoad(nobody, plan(2, false, 100, 200), 0);

        HttpLoad.Result result = load.run();

        assertThat(result.broken()).isEqualTo(20);
        assertThat(result.answered()).isZero();
    }

    private static HttpLoad.Plan plan(int connections, boolean newConnections, int rate, long millis) {
        return new HttpLoad.Plan(connections, newConnections, rate, BODY, 10, Duration.ofMillis(millis));
    }

    private static InetSocketAddress address(ServerSocket listening) {
        return (InetSocketAddress) listening.getLocalSocketAddress();
    }

    /** One connection. */
    private static void serve(ServerSocket listening, int status, Duration delayOfTheFirst) {
        byte[] answer = ("HTTP/1.1 " + status + " Status\r\nContent-Length: 0\r\n\r\n").getBytes(US_ASCII);
        try (Socket socket = listening.accept()) {
            InputStream in = socket.getInputStream();
            readRequest(in);
            new CompletableFuture<Void>()
                    .completeOnTimeout(null, delayOfTheFirst.toMillis(), TimeUnit.MILLISECONDS)
                    .join();
            do {
                socket.getOutputStream().write(answer);
            } while (readRequest(in));
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** False at the end of the connection. */
    private static boolean readRequest(InputStream in) throws IOException {
        StringBuilder head = new StringBuilder();
        while (head.indexOf("\r\n\r\n") < 0) {
            int next = in.read();
            if (next < 0) {
                return false;
            }
            head.append((char) next);
        }
        return in.readNBytes(BODY).length == BODY;
    }
}
