package io.furrow.suite;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.Socket;
import java.net.SocketException;
import java.net.SocketTimeoutException;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import static java.nio.charset.StandardCharsets.ISO_8859_1;

/** Sends requests written byte by byte, because HTTP clients do not allow to set {@code Host} and {@code Origin}. */
final class RawHttp {
    private static final Pattern STATUS = Pattern.compile("(?s)HTTP/1\\.[01] (\\d{3}).*");
    private static final int TIMEOUT_MS = 60_000;
    /** A server that does not respond in time speaks another protocol, and waits for more. */
    private static final int PROBE_TIMEOUT_MS = 20_000;

    private RawHttp() {}

    /** A raw response. */
    record Answer(int status, String text) {}

    /** Empty if the port does not answer with HTTP, or not at all. */
    static Optional<Answer> send(int port, String request) throws IOException {
        return send(port, request, TIMEOUT_MS);
    }

    /** Whether a port responds with HTTP. */
    static boolean isSpokenAt(int port) {
        try {
            return send(port, get("/", "Host: 127.0.0.1:" + port), PROBE_TIMEOUT_MS)
                    .isPresent();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static Optional<Answer> send(int port, String request, int timeoutMs) throws IOException {
        try (Socket socket = new Socket()) {
            socket.connect(new InetSocketAddress(InetAddress.getLoopbackAddress(), port), timeoutMs);
            socket.setSoTimeout(timeoutMs);
            socket.getOutputStream().write(request.getBytes(ISO_8859_1));
            socket.getOutputStream().flush();
            String text = new String(socket.getInputStream().readAllBytes(), ISO_8859_1);
            Matcher status = STATUS.matcher(text);
            return status.matches()
                    ? Optional.of(new Answer(Integer.parseInt(status.group(1)), text))
                    : Optional.empty();
        } catch (SocketTimeoutException | SocketException e) {
            return Optional.empty();
        }
    }

    /** A request without a body. */
    static String get(String path, String... headers) {
        return head("GET", path, headers) + "\r\n";
    }

    /** A POST that a page may send to any site without preflight, because of its content type. */
    static String simplePost(String path, String body, String... headers) {
        return head("POST", path, headers) + "Content-Type: text/plain\r\nContent-Length: " + body.length() + "\r\n\r\n"
                + body;
    }

    static String head(String method, String path, String... headers) {
        return method + " " + path + " HTTP/1.1\r\nConnection: close\r\n" + String.join("\r\n", headers) + "\r\n";
    }
}
