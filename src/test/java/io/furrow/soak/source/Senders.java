package io.furrow.soak.source;

import java.io.BufferedInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.InputStream;
import java.net.InetSocketAddress;
import java.net.Socket;
import java.time.Duration;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Connections that send numbered notifications of about 1 kB at a rate, each once, and store which were answered 200. A
 * broken connection is replaced for the next number.
 */
final class Senders {
    static final int CONNECTIONS = 16;
    /** The current time, because retention depends on the time of the event. */
    private static final long TIME = System.currentTimeMillis();

    private static final String FILLING = "x".repeat(700);

    private final int port;
    private final long nanosPerNotification;
    private final long startedAt = System.nanoTime();
    private final int first;
    private final AtomicInteger next;
    private final BitSet acknowledged;
    private final List<Thread> threads = new ArrayList<>();
    private volatile boolean stopped;

    /** @param acknowledged receives the numbers that were answered 200 */
    private Senders(int port, int perSecond, int first, BitSet acknowledged) {
        this.port = port;
        this.nanosPerNotification = Duration.ofSeconds(1).toNanos() / perSecond;
        this.first = first;
        this.next = new AtomicInteger(first);
        this.acknowledged = acknowledged;
    }

    static Senders start(int port, int perSecond, int first, BitSet acknowledged) {
        Senders senders = new Senders(port, perSecond, first, acknowledged);
        for (int i = 0; i < CONNECTIONS; i++) {
            Thread thread = new Thread(senders::send, "sender-" + i);
            thread.setDaemon(true);
            thread.start();
            senders.threads.add(thread);
        }
        return senders;
    }

    /** The first number that was not used. */
    int next() {
        return next.get();
    }

    private void send() {
        Socket socket = null;
        while (!stopped) {
            int number = next.getAndIncrement();
            LockSupport.parkNanos(startedAt + (number - first) * nanosPerNotification - System.nanoTime());
            try {
                if (socket == null) {
                    socket = connect();
                }
                if (post(socket, number) == 200) {
                    synchronized (acknowledged) {
                        acknowledged.set(number);
                    }
                }
            } catch (IOException e) {
                // without an answer a notification is not counted; Orion does not retry either
                closeQuietly(socket);
                socket = null;
            }
        }
        closeQuietly(socket);
    }

    private Socket connect() throws IOException {
        Socket socket = new Socket();
        socket.setTcpNoDelay(true);
        socket.setSoTimeout(15_000);
        socket.connect(new InetSocketAddress("127.0.0.1", port), 1_000);
        return socket;
    }

    private static int post(Socket socket, int number) throws IOException {
        byte[] body = """
                {"id": "urn:ngsi-ld:Thermometer:%d", "type": "Thermometer", "Number": {"type": "Integer", "value": %d}, \
                "Time": {"type": "Integer", "value": %d}, "Filling": {"type": "String", "value": "%s"}}""".formatted(number, number, TIME, FILLING).getBytes(UTF_8);
        String head =
                "POST /v2/notify HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\nContent-Length: "
                        + body.length + "\r\n\r\n";
        byte[] request = new byte[head.length() + body.length];
        System.arraycopy(head.getBytes(US_ASCII), 0, request, 0, head.length());
        System.arraycopy(body, 0, request, head.length(), body.length);
        socket.getOutputStream().write(request);
        return readStatus(new BufferedInputStream(socket.getInputStream()));
    }

    private static int readStatus(InputStream in) throws IOException {
        int status = Integer.parseInt(line(in).split(" ")[1]);
        int length = 0;
        for (String header = line(in); !header.isEmpty(); header = line(in)) {
            if (header.toLowerCase(java.util.Locale.ROOT).startsWith("content-length:")) {
                length = Integer.parseInt(
                        header.substring(header.indexOf(':') + 1).strip());
            }
        }
        in.readNBytes(length);
        return status;
    }

    private static String line(InputStream in) throws IOException {
        StringBuilder line = new StringBuilder();
        for (int read = in.read(); read != '\n'; read = in.read()) {
            if (read < 0) {
                throw new EOFException("the connection was closed");
            }
            if (read != '\r') {
                line.append((char) read);
            }
        }
        return line.toString();
    }

    private static void closeQuietly(Socket socket) {
        try {
            if (socket != null) {
                socket.close();
            }
        } catch (IOException e) {
            // the socket is no longer used
        }
    }

    /** Returns once every connection has received its last answer. */
    void stop() {
        stopped = true;
        for (Thread thread : threads) {
            try {
                thread.join(20_000);
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
    }
}
