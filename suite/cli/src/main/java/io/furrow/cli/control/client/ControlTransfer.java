package io.furrow.cli.control.client;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.io.OutputStream;
import java.io.UncheckedIOException;
import java.net.HttpURLConnection;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Transfers streams of any length to and from the REST API of a control plane. */
public final class ControlTransfer {
    private static final int BUFFER = 64 * 1024;
    private static final int OK = 200;

    private final ControlApi api;

    public ControlTransfer(ControlApi api) {
        this.api = api;
    }

    /**
     * Writes what is at a path.
     *
     * @throws ControlPlaneException if it is unavailable or refuses, or its answer is incomplete
     * @throws IOException if the stream cannot be written
     */
    public void download(String path, String type, OutputStream out) throws IOException {
        HttpURLConnection connection;
        try {
            connection = api.open("GET", path, type);
            if (connection.getResponseCode() != OK) {
                api.succeeded(ControlApi.received(connection));
            }
        } catch (IOException e) {
            throw api.noAnswer(e);
        }
        byte[] buffer = new byte[BUFFER];
        try (InputStream in = connection.getInputStream()) {
            for (int count = read(in, buffer); count >= 0; count = read(in, buffer)) {
                out.write(buffer, 0, count);
            }
        } finally {
            connection.disconnect();
        }
    }

    /** An answer that is broken off has no last chunk. */
    private static int read(InputStream in, byte[] buffer) {
        try {
            return in.read(buffer);
        } catch (IOException e) {
            throw new ControlPlaneException(
                    "The control plane has ended its answer early (%s). Its log says why; then repeat the command."
                            .formatted(e.getMessage()),
                    e);
        }
    }

    /**
     * Posts a stream and returns the answer.
     *
     * @throws ControlPlaneException if it is unavailable or refuses
     * @throws IOException if the stream cannot be read
     */
    public JsonNode upload(String path, String type, InputStream in) throws IOException {
        try {
            HttpURLConnection connection = api.open("POST", path, "application/json");
            connection.setRequestProperty("Content-Type", type);
            connection.setDoOutput(true);
            connection.setChunkedStreamingMode(BUFFER);
            byte[] buffer = new byte[BUFFER];
            try (OutputStream out = connection.getOutputStream()) {
                for (int count = readSource(in, buffer); count >= 0; count = readSource(in, buffer)) {
                    out.write(buffer, 0, count);
                }
            }
            return api.read(api.succeeded(ControlApi.received(connection)));
        } catch (UncheckedIOException e) {
            throw e.getCause();
        } catch (IOException e) {
            throw api.noAnswer(e);
        }
    }

    private static int readSource(InputStream in, byte[] buffer) {
        try {
            return in.read(buffer);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /**
     * Lines of an event stream, until it ends or the stream is closed.
     *
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public Stream<String> events(String path) {
        try {
            HttpURLConnection connection = api.open("GET", path, "text/event-stream");
            int status = connection.getResponseCode();
            if (status / 100 != 2) {
                connection.disconnect();
                throw new ControlPlaneException(
                        "The control plane answers %d to %s".formatted(status, path),
                        status == ControlApi.UNKNOWN,
                        null);
            }
            return new BufferedReader(new InputStreamReader(connection.getInputStream(), UTF_8))
                    .lines()
                    .onClose(connection::disconnect);
        } catch (IOException e) {
            throw api.noAnswer(e);
        }
    }
}
