package io.furrow.simulators.fiware;

import java.io.BufferedInputStream;
import java.io.Closeable;
import java.io.DataInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.OutputStream;
import java.net.InetSocketAddress;
import java.net.Socket;
import java.net.SocketTimeoutException;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import io.furrow.simulators.fiware.MqttPackets.Message;
import io.furrow.simulators.fiware.MqttPackets.Packet;

/** One connection to an MQTT broker, from CONNECT to its end. One thread receives, any may send. */
final class MqttConnection implements Closeable {
    private static final int DEFAULT_PORT = 1883;
    private static final int CONNECT_MS = 5_000;
    private static final int KEEP_ALIVE_SECONDS = 30;
    private static final long PING_AFTER_MS = 10_000;
    private static final int RECEIVE_BUFFER = 256 * 1024;
    private static final List<String> REFUSALS = List.of(
            "accepted",
            "unacceptable protocol version",
            "client id rejected",
            "server unavailable",
            "bad user name or password",
            "not authorized");

    private final Socket socket;
    private final DataInputStream in;
    private final OutputStream out;
    private final Consumer<Message> messages;
    private long lastSent = System.nanoTime();
    private boolean pinged;

    /** @throws IOException if the broker is not there or refuses */
    static MqttConnection open(FiwareSettings settings, String clientId, Consumer<Message> messages)
            throws IOException {
        int port = settings.mqttBroker().getPort();
        Socket socket = new Socket();
        // An acknowledgement held back by Nagle's algorithm makes the broker wait some 40 ms.
        socket.setTcpNoDelay(true);
        boolean open = false;
        try {
            socket.connect(
                    new InetSocketAddress(settings.mqttBroker().getHost(), port < 0 ? DEFAULT_PORT : port), CONNECT_MS);
            socket.setSoTimeout((int) PING_AFTER_MS);
            MqttConnection connection = new MqttConnection(socket, messages);
            connection.send(
                    MqttPackets.connect(clientId, settings.mqttUser(), settings.mqttPassword(), KEEP_ALIVE_SECONDS));
            int code = connection.await(MqttPackets.CONNACK).body()[1];
            if (code != 0) {
                throw new IOException(
                        "the MQTT broker refuses: " + (code < REFUSALS.size() ? REFUSALS.get(code) : "code " + code));
            }
            open = true;
            return connection;
        } finally {
            if (!open) {
                socket.close();
            }
        }
    }

    private MqttConnection(Socket socket, Consumer<Message> messages) throws IOException {
        this.socket = socket;
        this.messages = messages;
        in = new DataInputStream(new BufferedInputStream(socket.getInputStream(), RECEIVE_BUFFER));
        out = socket.getOutputStream();
    }

    void subscribe(List<String> filters) throws IOException {
        send(MqttPackets.subscribe(1, filters));
        for (byte granted : acknowledged(await(MqttPackets.SUBACK))) {
            if ((granted & 0x80) != 0) {
                throw new IOException("the MQTT broker refuses the subscription");
            }
        }
    }

    /** Hands every message on and acknowledges it afterwards, until the connection ends with an exception. */
    void receive() throws IOException {
        while (!socket.isClosed()) {
            next();
        }
    }

    void publish(String topic, byte[] payload) throws IOException {
        send(MqttPackets.publish(topic, payload));
    }

    /**
     * Begins the end: {@link #receive} ends when the broker has closed the connection. Ends the subscriptions too, because the
     * session outlives the connection and messages would gather in it.
     */
    void leave(List<String> filters) throws IOException {
        send(MqttPackets.unsubscribe(2, filters));
    }

    @Override
    public void close() throws IOException {
        socket.close();
    }

    private Packet await(int type) throws IOException {
        Packet packet = next();
        while (packet.type() != type) {
            packet = next();
        }
        return packet;
    }

    private Packet next() throws IOException {
        Packet packet = MqttPackets.read(firstByte(), in);
        if (packet.type() == MqttPackets.PUBLISH) {
            Message message = MqttPackets.message(packet);
            messages.accept(message);
            if (message.id() != 0) {
                send(MqttPackets.acknowledgement(message.id()));
            }
        } else if (packet.type() == MqttPackets.PINGRESP) {
            pinged = false;
        } else if (packet.type() == MqttPackets.UNSUBACK) {
            // Then the broker closes. Closing here at once makes Moquette trip over its own farewell.
            send(MqttPackets.disconnect());
            return packet;
        }
        if (System.nanoTime() - lastSent > TimeUnit.MILLISECONDS.toNanos(PING_AFTER_MS)) {
            send(MqttPackets.ping());
        }
        return packet;
    }

    /** Waits for a packet; a silence is broken with a ping, and a ping without an answer ends the connection. */
    private int firstByte() throws IOException {
        while (true) {
            try {
                int first = in.read();
                if (first < 0) {
                    throw new EOFException("the MQTT broker closed the connection");
                }
                return first;
            } catch (SocketTimeoutException e) {
                if (pinged) {
                    throw new IOException("the MQTT broker does not answer", e);
                }
                pinged = true;
                send(MqttPackets.ping());
            }
        }
    }

    private synchronized void send(byte[] packet) throws IOException {
        out.write(packet);
        lastSent = System.nanoTime();
    }

    private static byte[] acknowledged(Packet suback) {
        return Arrays.copyOfRange(suback.body(), 2, suback.body().length);
    }
}
