package io.furrow.soak.dashboard;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.WebSocket;
import java.nio.ByteBuffer;
import java.time.Duration;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

/** A socket that measures the age of records on arrival, and detects gaps. */
final class SoakSocket implements WebSocket.Listener {
    /** Milliseconds; greater ages count as this one. */
    static final int MAX_AGE = 20_000;

    private static final long TIMEOUT_SECONDS = 20;
    private static final String SENT = "\"sent\":";
    private static final String NUMBER = "\"n\":";

    private final boolean reads;
    private final int[] ages = new int[MAX_AGE + 1];
    private final StringBuilder text = new StringBuilder();
    private long next = -1;
    private long missing;
    private long records;
    private volatile String end;
    private WebSocket socket;

    private SoakSocket(boolean reads) {
        this.reads = reads;
    }

    /** @param reads whether it reads continuously, or only the first frame */
    static SoakSocket open(HttpClient http, URI at, boolean reads)
            throws InterruptedException, ExecutionException, TimeoutException {
        SoakSocket opened = new SoakSocket(reads);
        opened.socket = http.newWebSocketBuilder()
                .connectTimeout(Duration.ofSeconds(TIMEOUT_SECONDS))
                .buildAsync(at, opened)
                .get(TIMEOUT_SECONDS, TimeUnit.SECONDS);
        return opened;
    }

    @Override
    public void onOpen(WebSocket opened) {
        opened.request(reads ? Long.MAX_VALUE : 1);
    }

    @Override
    public CompletionStage<?> onText(WebSocket from, CharSequence part, boolean last) {
        text.append(part);
        if (last) {
            measure(text.toString(), System.currentTimeMillis());
            text.setLength(0);
        }
        return null;
    }

    private synchronized void measure(String frame, long now) {
        for (int at = frame.indexOf(SENT); at >= 0; at = frame.indexOf(SENT, at + 1)) {
            long sent = number(frame, at + SENT.length());
            long n = number(frame, frame.indexOf(NUMBER, at) + NUMBER.length());
            ages[(int) Math.max(0, Math.min(MAX_AGE, now - sent))]++;
            missing += next >= 0 && n != next ? 1 : 0;
            next = n + 1;
            records++;
        }
    }

    private static long number(String text, int from) {
        long number = 0;
        for (int i = from; i < text.length() && Character.isDigit(text.charAt(i)); i++) {
            number = number * 10 + text.charAt(i) - '0';
        }
        return number;
    }

    /** Resets the counts, but not the expected number of the next record. */
    synchronized void resetCounts() {
        java.util.Arrays.fill(ages, 0);
        records = 0;
        missing = 0;
    }

    synchronized void addTo(long[] all) {
        for (int i = 0; i < ages.length; i++) {
            all[i] += ages[i];
        }
    }

    synchronized long records() {
        return records;
    }

    /** The number of records that did not follow the previous one. */
    synchronized long missing() {
        return missing;
    }

    /** Null while the socket is open. */
    String end() {
        return end;
    }

    /** Reads one more frame. */
    void readFrame() {
        socket.request(1);
    }

    /** Cuts the connection without a close frame. */
    void drop() {
        socket.abort();
    }

    @Override
    public CompletionStage<?> onPing(WebSocket from, ByteBuffer message) {
        return null;
    }

    @Override
    public CompletionStage<?> onClose(WebSocket from, int code, String reason) {
        end = code + " " + reason;
        return null;
    }

    @Override
    public void onError(WebSocket from, Throwable error) {
        end = error.toString();
    }
}
