package io.furrow.simulators.mqtt;

import java.io.DataInputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.net.URI;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * As much of an MQTT broker as one publisher needs; the first message of all it drops without a word, as a busy one does, or, where
 * told to, the connection at the first subscription.
 */
final class ForgetfulBroker implements AutoCloseable {
    private static final int CONNECT = 1;
    private static final int PUBLISH = 3;
    private static final int SUBSCRIBE = 8;

    private final ServerSocket server = new ServerSocket(0, 5, InetAddress.getLoopbackAddress());
    private final List<String> taken = new CopyOnWriteArrayList<>();
    private final boolean cuts;
    private boolean forgot;

    /** @param cuts the connection instead of dropping a message */
    ForgetfulBroker(boolean cuts) throws IOException {
        this.cuts = cuts;
        Thread thread = new Thread(this::serve, "forgetful-broker");
        thread.setDaemon(true);
        thread.start();
    }

    URI uri() {
        return URI.create("tcp://127.0.0.1:" + server.getLocalPort());
    }

    /** The messages that it has acknowledged, in order. */
    List<String> taken() {
        return taken;
    }

    private void serve() {
        while (!server.isClosed()) {
            try (Socket socket = server.accept();
                    DataInputStream in = new DataInputStream(socket.getInputStream());
                    OutputStream out = socket.getOutputStream()) {
                for (int first = in.read(); first >= 0; first = in.read()) {
                    // Packets of a test are short: their length is one byte.
                    answer(first >> 4, in.readNBytes(in.read()), out);
                }
            } catch (IOException e) {
                // The other end broke off, or the test is over.
            }
        }
    }

    private void answer(int kind, byte[] packet, OutputStream out) throws IOException {
        if (kind == CONNECT) {
            out.write(new byte[] {0x20, 2, 0, 0});
        } else if (kind == SUBSCRIBE && cuts && !forgot) {
            forgot = true;
            throw new IOException("cut");
        } else if (kind == SUBSCRIBE) {
            out.write(new byte[] {(byte) 0x90, 3, packet[0], packet[1], 1});
        } else if (kind == PUBLISH && !forgot) {
            forgot = true;
        } else if (kind == PUBLISH) {
            int id = 2 + ((packet[0] & 0xff) << 8 | packet[1] & 0xff);
            taken.add(new String(packet, id + 2, packet.length - id - 2, UTF_8));
            out.write(new byte[] {0x40, 2, packet[id], packet[id + 1]});
        }
    }

    @Override
    public void close() throws IOException {
        server.close();
    }
}
