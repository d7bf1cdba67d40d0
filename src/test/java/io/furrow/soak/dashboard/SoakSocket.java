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

/** A socket that notes how old records are when they arrive, and whether one is missing. */
final class SoakSocket implements WebSocket.Listener {
    /** Milliseconds; what is later is counted with the last. */
    static final int LATEST = 20_000;

    private static final long TIMEOUT_SECONDS = 20;
    private static final String SENT = "\"sent\":";
    private static final String NUMBER = "\"n\":";

    private final boolean reads;
    private final int[] ages = new int[LATEST + 1];
    private final StringBuilder text = new StringBuilder();
    private long next = -1;
    private long missing;
    private long records;
    private volatile String end;
    private WebSocket socket;

    private SoakSocket(boolean reads) {
        this.reads = reads;
    }

    /** @param reads whether it takes more than what comes before it is asked for */
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
            note(text.toString(), System.currentTimeMillis());
            text.setLength(0);
        }
        return null;
    }

    private synchronized void note(String frame, long now) {
        for (int at = frame.indexOf(SENT); at >= 0; at = frame.indexOf(SENT, at + 1)) {
            long sent = number(frame, at + SENT.length());
            long n = number(frame, frame.indexOf(NUMBER, at) + NUMBER.length());
            ages[(int) Math.max(0, Math.min(LATEST, now - sent))]++;
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

    /** From now on; what was noted so far is forgotten, but for the number of the record that comes next. */
    synchronized void begin() {
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

    /** How often a record was not the one after that before it. */
    synchronized long missing() {
        return missing;
    }

    /** Null while it is open. */
    String end() {
        return end;
    }

    /** A little of what waits. */
    void readALittle() {
        socket.request(1);
    }

    /** The connection is cut, and nothing said. */
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
