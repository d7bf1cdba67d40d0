package io.furrow.connect.source;

import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.net.Socket;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.LongAdder;

import static java.nio.charset.StandardCharsets.US_ASCII;

/**
 * Senders that press with all they have: each its own connection, one notification after the other without a pause, and a
 * new connection whenever one is cut. Also a program, with arguments port, senders, bytes of a body and seconds.
 */
public final class PressingSenders {
    private final int port;
    private final byte[] request;
    private final LongAdder answered = new LongAdder();
    private final LongAdder cut = new LongAdder();

    PressingSenders(int port, int bodyBytes) {
        this.port = port;
        String frame = "{\"id\": \"a\", \"type\": \"T\", \"x\": \"\"}";
        String body = frame.replace("\"\"", "\"" + "x".repeat(bodyBytes - frame.length()) + "\"");
        String head = "POST /v2/notify HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + body.length() + "\r\n\r\n";
        this.request = (head + body).getBytes(US_ASCII);
    }

    /** Runs as a program. */
    public static void main(String[] arguments) throws InterruptedException {
        PressingSenders senders = new PressingSenders(Integer.parseInt(arguments[0]), Integer.parseInt(arguments[2]));
        senders.press(Integer.parseInt(arguments[1]), Duration.ofSeconds(Long.parseLong(arguments[3])));
        System.out.println(senders.answered() + " answered, " + senders.cut() + " cut");
    }

    void press(int senders, Duration duration) throws InterruptedException {
        long end = System.nanoTime() + duration.toNanos();
        List<Thread> threads = new ArrayList<>();
        for (int i = 0; i < senders; i++) {
            Thread thread = new Thread(() -> send(end), "sender-" + i);
            thread.setDaemon(true);
            thread.start();
            threads.add(thread);
        }
        for (Thread thread : threads) {
            thread.join(duration.toMillis() + 30_000);
        }
    }

    private void send(long end) {
        byte[] answer = new byte[1024];
        while (System.nanoTime() < end) {
            try (Socket socket = new Socket("127.0.0.1", port)) {
                socket.setSoTimeout(60_000);
                OutputStream out = socket.getOutputStream();
                InputStream in = socket.getInputStream();
                while (System.nanoTime() < end) {
                    out.write(request);
                    if (in.read(answer) < 0) {
                        throw new IOException("closed");
                    }
                    answered.increment();
                }
            } catch (IOException e) {
                cut.increment();
            }
        }
    }

    long answered() {
        return answered.sum();
    }

    long cut() {
        return cut.sum();
    }
}
