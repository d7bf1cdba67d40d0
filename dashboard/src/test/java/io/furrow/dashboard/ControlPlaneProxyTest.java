package io.furrow.dashboard;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.stream.Stream;

import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.TopicRules;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;

class ControlPlaneProxyTest {
    private final HttpClient http = HttpClient.newHttpClient();
    private final List<String> processed = new CopyOnWriteArrayList<>();
    private final Server server = new Server();
    private final ServerConnector connector = new ServerConnector(server, 1, 1);
    private ControlPlaneProxy proxy;
    private ServerSocket upstream;

    @BeforeEach
    void start() throws Exception {
        upstream = new ServerSocket(0, 50, InetAddress.getLoopbackAddress());
        new Thread(this::accept, "upstream").start();
        connector.setHost("127.0.0.1");
        server.addConnector(connector);
        proxy = new ControlPlaneProxy(URI.create("http://127.0.0.1:" + upstream.getLocalPort()), TopicRules.DEFAULT);
        server.setHandler(proxy);
        server.start();
    }

    @AfterEach
    void stop() throws Exception {
        server.stop();
        upstream.close();
    }

    private void accept() {
        while (!upstream.isClosed()) {
            try {
                Socket socket = upstream.accept();
                new Thread(() -> answerOnce(socket), "connection").start();
            } catch (IOException e) {
                if (!upstream.isClosed()) {
                    throw new UncheckedIOException(e);
                }
            }
        }
    }

    /**
     * Answers one request without {@code Connection: close}, and closes the connection when it is reused or the peer
     * has closed it.
     */
    private void answerOnce(Socket socket) {
        try (socket) {
            BufferedReader reader = new BufferedReader(new InputStreamReader(socket.getInputStream(), US_ASCII));
            String request = reader.readLine();
            if (request == null) {
                return; // it was opened in vain
            }
            int length = 0;
            for (String line = reader.readLine(); !line.isEmpty(); line = reader.readLine()) {
                if (line.toLowerCase(Locale.ROOT).startsWith("content-length:")) {
                    length = Integer.parseInt(line.replaceAll("\\D", ""));
                }
            }
            reader.skip(length);
            processed.add(request.replace(" HTTP/1.1", ""));
            socket.getOutputStream().write("HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\n{}".getBytes(US_ASCII));
            reader.read();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private CompletableFuture<Integer> request(String method, String body) {
        URI uri = URI.create("http://127.0.0.1:" + connector.getLocalPort() + "/api/domains");
        HttpRequest.BodyPublisher content =
                body.isEmpty() ? HttpRequest.BodyPublishers.noBody() : HttpRequest.BodyPublishers.ofString(body);
        var request = HttpRequest.newBuilder(uri).method(method, content).build();
        return http.sendAsync(request, HttpResponse.BodyHandlers.discarding()).thenApply(HttpResponse::statusCode);
    }

    @Test
    void retriesAReadWhoseReusedConnectionIsClosed() {
        for (int round = 0; round < 3; round++) {
            List<CompletableFuture<Integer>> concurrent =
                    Stream.generate(() -> request("GET", "")).limit(8).toList();
            assertThat(concurrent).allMatch(answer -> answer.join() == 200);
        }
        assertThat(processed).hasSize(24);
    }

    @Test
    void sendsEachCommandOnceOnANewConnection() {
        assertThat(request("GET", "").join()).isEqualTo(200);
        assertThat(request("POST", "{}").join()).isEqualTo(200);
        assertThat(request("POST", "").join()).isEqualTo(200);
        assertThat(request("DELETE", "").join()).isEqualTo(200);
        assertThat(processed)
                .containsExactly("GET /api/domains", "POST /api/domains", "POST /api/domains", "DELETE /api/domains");
    }

    @Test
    void closesIdleConnectionsLongBeforeAServerDoes() {
        assertThat(proxy.getHttpClient().getIdleTimeout()).isLessThanOrEqualTo(connector.getIdleTimeout() / 2);
    }

    @Test
    void reportsThatTheControlPlaneIsUnavailable() throws Exception {
        upstream.close();

        assertThat(request("GET", "").join()).isEqualTo(502);
        assertThat(request("POST", "{}").join()).isEqualTo(502);
    }
}
