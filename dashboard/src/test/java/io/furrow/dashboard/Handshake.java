package io.furrow.dashboard;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.Socket;
import java.net.URI;

import static java.nio.charset.StandardCharsets.US_ASCII;

/** Sends the first request of a WebSocket with headers that Java's clients do not allow to set. */
final class Handshake {
    private Handshake() {}

    /** Opens a WebSocket from which nothing is read; Java's client may miss the end of such a connection. */
    static Socket open(URI socket) throws IOException {
        return send(socket, socket.getAuthority());
    }

    /** @return the status of the response */
    static int status(URI socket, String host, String... headers) throws IOException {
        try (Socket connection = send(socket, host, headers)) {
            String line = new BufferedReader(new InputStreamReader(connection.getInputStream(), US_ASCII)).readLine();
            return Integer.parseInt(line.split(" ")[1]);
        }
    }

    private static Socket send(URI socket, String host, String... headers) throws IOException {
        StringBuilder request = new StringBuilder("GET %s HTTP/1.1\r\nHost: %s\r\n".formatted(socket.getPath(), host))
                .append("Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n")
                .append("Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n");
        for (int i = 0; i < headers.length; i += 2) {
            request.append(headers[i]).append(": ").append(headers[i + 1]).append("\r\n");
        }
        Socket connection = new Socket(socket.getHost(), socket.getPort());
        connection.getOutputStream().write(request.append("\r\n").toString().getBytes(US_ASCII));
        return connection;
    }
}
