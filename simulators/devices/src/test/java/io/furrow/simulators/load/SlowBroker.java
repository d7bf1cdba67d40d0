package io.furrow.simulators.load;

import java.io.DataInputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.net.URI;
import java.util.concurrent.CountDownLatch;

/** As much of an MQTT broker as one publisher needs; acknowledges nothing before it is told to. */
final class SlowBroker implements AutoCloseable {
    private static final byte[] CONNACK = {0x20, 2, 0, 0};
    private static final int CONNECT = 1;
    private static final int PUBLISH = 3;

    private final ServerSocket server = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
    private final CountDownLatch timeout = new CountDownLatch(1);

    private volatile Socket current;

    SlowBroker() throws IOException {
        Thread thread = new Thread(this::serve, "slow-broker");
        thread.setDaemon(true);
        thread.start();
    }

    URI uri() {
        return URI.create("tcp://127.0.0.1:" + server.getLocalPort());
    }

    /** Breaks the connection of the moment; the next one is served like the first. */
    void hangUp() throws IOException {
        current.close();
    }

    void acknowledge() {
        timeout.countDown();
    }

    @Override
    public void close() throws IOException {
        timeout.countDown();
        server.close();
    }

    private void serve() {
        while (!server.isClosed()) {
            serveOne();
        }
    }

    private void serveOne() {
        try (Socket socket = server.accept();
                DataInputStream in = new DataInputStream(socket.getInputStream());
                OutputStream out = socket.getOutputStream()) {
            current = socket;
            for (int first = in.read(); first >= 0; first = in.read()) {
                byte[] packet = in.readNBytes(remaining(in));
                if (first >> 4 == CONNECT) {
                    out.write(CONNACK);
                } else if (first >> 4 == PUBLISH) {
                    timeout.await();
                    int id = 2 + ((packet[0] & 0xff) << 8 | packet[1] & 0xff);
                    out.write(new byte[] {0x40, 2, packet[id], packet[id + 1]});
                }
            }
        } catch (IOException e) {
            // The other end broke off, or the test is over.
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private static int remaining(DataInputStream in) throws IOException {
        int length = 0;
        int shift = 0;
        int digit;
        do {
            digit = in.readUnsignedByte();
            length |= (digit & 0x7f) << shift;
            shift += 7;
        } while ((digit & 0x80) != 0);
        return length;
    }
}
