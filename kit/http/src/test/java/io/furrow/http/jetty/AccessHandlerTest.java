package io.furrow.http.jetty;

import java.io.IOException;
import java.net.InetAddress;
import java.net.Socket;
import java.nio.ByteBuffer;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;

import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.util.Callback;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.http.AccessRule;
import io.furrow.http.AllowedNames;
import io.furrow.http.OptionNames;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;

class AccessHandlerTest {
    private static final int TIMEOUT_MS = 60_000;

    private final AtomicInteger handled = new AtomicInteger();
    private final Server server = new Server();
    private final ServerConnector connector = new ServerConnector(server);

    private final class Counting extends Handler.Abstract {
        @Override
        public boolean handle(Request request, Response response, Callback callback) {
            handled.incrementAndGet();
            response.write(true, ByteBuffer.wrap("hello".getBytes(US_ASCII)), callback);
            return true;
        }
    }

    @BeforeEach
    void start() throws Exception {
        connector.setHost("127.0.0.1");
        server.addConnector(connector);
        AccessRule rule = AccessRule.allowing(
                new AllowedNames(List.of(), List.of("https://map.example.org")), new OptionNames("hosts", "origins"));
        server.setHandler(new AccessHandler(
                rule, refused -> ("{\"error\":\"" + refused.error() + "\"}").getBytes(US_ASCII), new Counting()));
        server.start();
    }

    @AfterEach
    void stop() throws Exception {
        server.stop();
    }

    @Test
    void passesOwnRequestsUnchanged() throws IOException {
        assertThat(send("GET / HTTP/1.1\r\nConnection: close\r\nHost: localhost\r\n\r\n"))
                .startsWith("HTTP/1.1 200 ")
                .endsWith("hello")
                .doesNotContainIgnoringCase("access-control");
    }

    @Test
    void rejectsWithTheServersBodyBeforeTheHandlerIsCalled() throws IOException {
        assertThat(send("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"))
                .startsWith("HTTP/1.1 403 ")
                .containsIgnoringCase("content-type: application/json")
                .endsWith("{\"error\":\"foreign-host\"}");
        assertThat(handled).hasValue(0);
    }

    @Test
    void answersWhileABodyIsStillBeingSent() throws IOException {
        String head =
                "POST / HTTP/1.1\r\nHost: localhost\r\nOrigin: https://evil.example\r\nContent-Type: text/plain\r\n";
        try (Socket socket = connect()) {
            write(socket, head + "Content-Length: 4\r\n\r\n");
            write(socket, "late");
            assertThat(read(socket)).endsWith("{\"error\":\"foreign-origin\"}");
        }
        assertThat(send(head + "Content-Length: 100000000\r\n\r\nx")).endsWith("{\"error\":\"foreign-origin\"}");
        assertThat(send(head + "Transfer-Encoding: chunked\r\n\r\n1\r\nx\r\n"))
                .endsWith("{\"error\":\"foreign-origin\"}");
        assertThat(handled).hasValue(0);
    }

    @Test
    void answersPreflightsAndRequestsOfAnAllowedOrigin() throws IOException {
        String page = " / HTTP/1.1\r\nConnection: close\r\nHost: localhost\r\nOrigin: https://map.example.org\r\n";

        assertThat(send("OPTIONS" + page + "Access-Control-Request-Method: PUT\r\n\r\n"))
                .startsWith("HTTP/1.1 204 ")
                .contains("Access-Control-Allow-Origin: https://map.example.org", "Access-Control-Allow-Methods: PUT");
        assertThat(handled).hasValue(0);
        assertThat(send("GET" + page + "\r\n"))
                .startsWith("HTTP/1.1 200 ")
                .contains("Access-Control-Allow-Origin: https://map.example.org")
                .endsWith("hello");
    }

    /** Jetty itself rejects some of these before any handler. */
    @ParameterizedTest
    @ValueSource(
            strings = {
                "GET / HTTP/1.1\r\n\r\n",
                "GET / HTTP/1.0\r\n\r\n",
                "GET / HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n",
                "GET / HTTP/1.1\r\nHost: \r\n\r\n",
                "GET http://evil.example/ HTTP/1.1\r\nHost: localhost\r\n\r\n",
                "GET http://evil.example/ HTTP/1.0\r\n\r\n",
                "GET http://localhost/ HTTP/1.1\r\nHost: evil.example\r\n\r\n",
                "GET / HTTP/1.1\r\nHost: localhost@evil.example\r\n\r\n",
                "GET / HTTP/1.1\r\nhOST: evil.example\r\n\r\n",
                "GET / HTTP/1.1\r\nHost: localhost\r\noRIGIN: https://evil.example\r\n\r\n",
                "GET / HTTP/1.1\r\nHost: evil.example\r\nX-Forwarded-Host: localhost\r\n\r\n"
            })
    void rejectsRequestsThatNameAnotherHostOrNone(String request) throws IOException {
        assertThat(send(request)).matches("(?s)HTTP/1\\.1 40[03] .*");
        assertThat(handled).hasValue(0);
    }

    private Socket connect() throws IOException {
        Socket socket = new Socket(InetAddress.getLoopbackAddress(), connector.getLocalPort());
        socket.setSoTimeout(TIMEOUT_MS);
        return socket;
    }

    private static void write(Socket socket, String text) throws IOException {
        socket.getOutputStream().write(text.getBytes(US_ASCII));
        socket.getOutputStream().flush();
    }

    /** Reads until the server closes the connection, which the tests expect. */
    private static String read(Socket socket) throws IOException {
        return new String(socket.getInputStream().readAllBytes(), US_ASCII);
    }

    private String send(String request) throws IOException {
        try (Socket socket = connect()) {
            write(socket, request);
            return read(socket);
        }
    }
}
