package io.furrow.simulators.mqtt;

import java.io.IOException;
import java.time.Duration;
import java.util.Arrays;
import java.util.Collection;
import java.util.Map;
import java.util.Queue;
import java.util.UUID;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeUnit;
import java.util.function.BiConsumer;

import org.eclipse.paho.client.mqttv3.IMqttActionListener;
import org.eclipse.paho.client.mqttv3.IMqttDeliveryToken;
import org.eclipse.paho.client.mqttv3.IMqttToken;
import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
import org.eclipse.paho.client.mqttv3.MqttCallbackExtended;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.MqttMessage;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Connects a device or a gateway to the MQTT broker. At QoS 1 a message is stored until the broker acknowledges it, and
 * sent again after a reconnect: none is lost, the order stays, one may arrive twice. Independent of the session in the
 * broker, which a restart may lose. Used by one thread, which calls {@link #push} often.
 */
public final class MqttConnection implements MqttCallbackExtended, AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(MqttConnection.class);
    private static final int CONNECT_SECONDS = 10;
    /**
     * Time for a broker to accept or refuse. Paho itself waits forever for a broker that does not answer, or if a
     * connection is cut while Paho starts its threads.
     */
    static final Duration RESPONSE_TIMEOUT = Duration.ofSeconds(15);

    /** Enough for 10,000 in a second; brokers drop messages above their rate. */
    private static final int INFLIGHT = 100;

    private static final int COMMAND_QOS = 1;
    private static final int TOPICS_PER_SUBSCRIPTION = 100;
    private static final long CLOSE_MS = 100;
    private static final long RETRY_NANOS = TimeUnit.SECONDS.toNanos(1);
    private static final long STALLED_NANOS = TimeUnit.SECONDS.toNanos(10);

    private final MqttAccess access;
    private final MqttAccess.Login login;
    private final MqttAsyncClient client;
    private MessageQueue queue;
    private final Queue<Long> acknowledgements = new ConcurrentLinkedQueue<>();
    private final BiConsumer<String, byte[]> received;
    private final String[] topics;
    private final int inflight;
    private volatile boolean closed;
    private long lastAttempt = System.nanoTime();
    private final Outage outage = new Outage(System::nanoTime);
    private Long watched;
    private long watchedSince;

    /**
     * The purpose and limits of a connection.
     *
     * @param login user name and password
     * @param name start of the client id; its end is random, so that two fleets do not evict each other
     * @param topics subscribed to, again after each reconnect
     * @param maxMessages maximum number waiting for the broker, at QoS 1
     * @param maxBytes their maximum memory, approximately
     * @param inflight maximum number sent and not acknowledged
     */
    public record Plan(
            MqttAccess.Login login,
            String name,
            Collection<String> topics,
            int maxMessages,
            long maxBytes,
            int inflight) {
        /** With {@value #INFLIGHT} messages in flight. */
        public Plan(MqttAccess.Login login, String name, Collection<String> topics, int maxMessages, long maxBytes) {
            this(login, name, topics, maxMessages, maxBytes, INFLIGHT);
        }
    }

    private MqttConnection(MqttAccess access, Plan plan, MqttAsyncClient client, BiConsumer<String, byte[]> received) {
        this.access = access;
        this.login = plan.login();
        this.queue = new MessageQueue(plan.maxMessages(), plan.maxBytes());
        this.topics = plan.topics().toArray(String[]::new);
        this.inflight = plan.inflight();
        this.client = client;
        this.received = received;
    }

    /**
     * Connects.
     *
     * @param received receives topic and payload of messages, on a thread of the client
     * @throws IOException naming broker and user, if the broker is unavailable, refuses, or does not answer
     */
    public static MqttConnection open(MqttAccess access, Plan plan, BiConsumer<String, byte[]> received)
            throws IOException {
        return open(access, plan, received, RESPONSE_TIMEOUT);
    }

    static MqttConnection open(
            MqttAccess access, Plan plan, BiConsumer<String, byte[]> received, Duration responseTimeout)
            throws IOException {
        String id = plan.name() + "-" + UUID.randomUUID().toString().substring(0, 8);
        boolean open = false;
        MqttConnection connection = null;
        try {
            MqttAsyncClient client = new MqttAsyncClient(access.broker().toString(), id, new MemoryPersistence());
            connection = new MqttConnection(access, plan, client, received);
            client.setCallback(connection);
            client.connect(connection.options()).waitForCompletion(responseTimeout.toMillis());
            open = true;
            return connection;
        } catch (MqttException e) {
            throw new IOException(access.refusal(plan.login(), e), e);
        } finally {
            if (!open && connection != null) {
                connection.close();
            }
        }
    }

    /**
     * Takes over the unacknowledged messages of another connection of the same device, which must not be used any more.
     */
    public void takeOver(MqttConnection other) {
        queue = other.queue;
        queue.broken();
    }

    /** Publishes a message, at once if connected; with QoS 0 only then. */
    public void send(String topic, byte[] payload) {
        if (access.qos() == 1) {
            queue.add(new MessageQueue.Message(topic, payload));
            push();
        } else if (ready()) {
            publish(topic, payload, 0, null);
        }
    }

    /** Sends waiting messages; reconnects if needed, at most once a second. */
    public void push() {
        for (Long number = acknowledgements.poll(); number != null; number = acknowledgements.poll()) {
            queue.acknowledged(number);
        }
        disconnectIfStalled();
        if (!ready()) {
            queue.broken();
            return;
        }
        for (Map.Entry<Long, MessageQueue.Message> next = queue.first();
                next != null && queue.inFlight() < inflight;
                next = queue.first()) {
            MessageQueue.Message message = next.getValue();
            if (!publish(message.topic(), message.payload(), 1, new Acknowledgement(next.getKey()))) {
                return;
            }
            queue.sent(next.getKey());
        }
    }

    /** A broker that dropped a message acknowledges it only after a retransmission over another connection. */
    private void disconnectIfStalled() {
        Long oldest = queue.oldestInFlight();
        if (oldest == null || !oldest.equals(watched)) {
            watched = oldest;
            watchedSince = System.nanoTime();
        } else if (System.nanoTime() - watchedSince > STALLED_NANOS) {
            LOG.warn("{} has a message that is not acknowledged, and reconnects", this);
            watched = null;
            try {
                client.disconnectForcibly(0, CLOSE_MS, false);
            } catch (MqttException e) {
                LOG.debug("{} could not be disconnected", this, e);
            }
        }
    }

    /** Messages acknowledged by the broker, at QoS 1. */
    public long acknowledged() {
        return queue.acknowledged();
    }

    /** Messages not acknowledged yet, at QoS 1. */
    public int open() {
        return queue.open();
    }

    /** Messages dropped because too many waited. */
    public long dropped() {
        return queue.dropped();
    }

    @Override
    public void connectComplete(boolean again, String uri) {
        outage.end();
        try {
            for (int from = 0; from < topics.length; from += TOPICS_PER_SUBSCRIPTION) {
                String[] some =
                        Arrays.copyOfRange(topics, from, Math.min(topics.length, from + TOPICS_PER_SUBSCRIPTION));
                int[] qos = new int[some.length];
                Arrays.fill(qos, COMMAND_QOS);
                client.subscribe(some, qos);
            }
        } catch (MqttException e) {
            LOG.warn("{} receives no commands until it reconnects", this, e);
        }
    }

    @Override
    public void connectionLost(Throwable cause) {
        outage.begin(this, cause.getMessage());
    }

    @Override
    public void messageArrived(String topic, MqttMessage message) {
        received.accept(topic, message.getPayload());
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        // Each message has its own listener.
    }

    /** Disconnects within half a second, also when the broker hangs; a second call does nothing. */
    @Override
    public void close() {
        if (closed) {
            return;
        }
        closed = true;
        client.setCallback(null);
        try {
            client.disconnectForcibly(0, CLOSE_MS, client.isConnected());
        } catch (MqttException e) {
            LOG.debug("{} could not disconnect", this, e);
        }
        try {
            client.close(true);
        } catch (MqttException e) {
            LOG.warn("{} could not be closed", this, e);
        }
    }

    /** Client id, user and broker. */
    @Override
    public String toString() {
        return client.getClientId() + " as '" + login.user() + "' at " + access.broker();
    }

    private boolean ready() {
        if (client.isConnected()) {
            return true;
        }
        if (!closed && System.nanoTime() - lastAttempt > RETRY_NANOS) {
            lastAttempt = System.nanoTime();
            outage.report(this);
            try {
                client.reconnect();
            } catch (MqttException e) {
                LOG.debug("{} is not connected yet", this, e);
            }
        }
        return false;
    }

    private boolean publish(String topic, byte[] payload, int qos, IMqttActionListener listener) {
        try {
            client.publish(topic, payload, qos, false, null, listener);
            return true;
        } catch (MqttException e) {
            LOG.debug("{} accepts no message now", this, e);
            return false;
        }
    }

    private MqttConnectOptions options() throws IOException {
        MqttConnectOptions options = new MqttConnectOptions();
        options.setMqttVersion(MqttConnectOptions.MQTT_VERSION_3_1_1);
        options.setUserName(login.user());
        options.setPassword(login.password().toCharArray());
        options.setCleanSession(true);
        options.setConnectionTimeout(CONNECT_SECONDS);
        options.setMaxInflight(2 * inflight);
        options.setSocketFactory(access.isEncrypted() ? access.encryptedSockets() : new NoDelaySockets());
        return options;
    }

    /** Records the acknowledgement of one message; a failed message is sent again after a reconnect. */
    private final class Acknowledgement implements IMqttActionListener {
        private final long number;

        Acknowledgement(long number) {
            this.number = number;
        }

        @Override
        public void onSuccess(IMqttToken token) {
            acknowledgements.add(number);
        }

        @Override
        public void onFailure(IMqttToken token, Throwable cause) {
            LOG.debug("{} has a message that was not delivered", MqttConnection.this, cause);
        }
    }
}
