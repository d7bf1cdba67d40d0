package io.furrow.dashboard;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.WebSocket;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.CopyOnWriteArrayList;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;

/** A WebSocket that collects the text frames it receives. */
final class SocketClient implements WebSocket.Listener {
    private final List<String> frames = new CopyOnWriteArrayList<>();
    private final StringBuilder text = new StringBuilder();
    private final boolean reads;
    private volatile int code = -1;
    private volatile String reason = "";
    private volatile boolean failed;
    private WebSocket socket;

    private SocketClient(boolean reads) {
        this.reads = reads;
    }

    static SocketClient open(HttpClient http, URI at) {
        return open(http, at, true);
    }

    /** @param reads whether it receives more than the first frame */
    static SocketClient open(HttpClient http, URI at, boolean reads) {
        SocketClient client = new SocketClient(reads);
        client.socket = http.newWebSocketBuilder().buildAsync(at, client).join();
        return client;
    }

    List<String> frames() {
        return frames;
    }

    /** The records of all frames. */
    List<JsonNode> records() throws Exception {
        List<JsonNode> records = new ArrayList<>();
        for (String frame : frames) {
            NgsiJson.read(frame.getBytes(UTF_8)).path("records").forEach(records::add);
        }
        return records;
    }

    /** The number of records that newer ones replaced. */
    long merged() throws Exception {
        long merged = 0;
        for (String frame : frames) {
            merged += NgsiJson.read(frame.getBytes(UTF_8)).path("merged").asLong();
        }
        return merged;
    }

    /** −1 while the socket is open. */
    int code() {
        return code;
    }

    String reason() {
        return reason;
    }

    boolean isOver() {
        return failed || code >= 0;
    }

    void send(String message) {
        socket.sendText(message, true).join();
    }

    void drop() {
        socket.abort();
    }

    void close() {
        socket.sendClose(WebSocket.NORMAL_CLOSURE, "").join();
    }

    void resume() {
        socket.request(Long.MAX_VALUE);
    }

    @Override
    public void onOpen(WebSocket opened) {
        opened.request(1);
    }

    @Override
    public CompletionStage<?> onText(WebSocket from, CharSequence part, boolean last) {
        text.append(part);
        if (last) {
            frames.add(text.toString());
            text.setLength(0);
        }
        if (reads) {
            from.request(1);
        }
        return null;
    }

    @Override
    public CompletionStage<?> onPing(WebSocket from, java.nio.ByteBuffer message) {
        if (reads) {
            from.request(1);
        }
        return null;
    }

    @Override
    public CompletionStage<?> onClose(WebSocket from, int status, String why) {
        code = status;
        reason = why;
        return null;
    }

    @Override
    public void onError(WebSocket from, Throwable error) {
        failed = true;
    }
}
