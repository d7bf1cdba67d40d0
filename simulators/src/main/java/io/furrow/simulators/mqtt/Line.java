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

import io.furrow.simulators.device.NoDelaySockets;

/**
 * A connection to the MQTT broker, of one device or of a gateway. At QoS 1 a message is kept until the broker has acknowledged
 * it, and sent again after a break: nothing is lost, the order stays, a message may arrive twice. This does not build on the
 * broker's memory, which a restart may cost it. One thread uses a line; it calls {@link #push} often.
 */
public final class Line implements MqttCallbackExtended, AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Line.class);
    private static final int CONNECT_SECONDS = 10;
    /**
     * Within which a broker accepts or refuses. Paho itself waits for ever: for a broker that says nothing, and where a connection is
     * cut while Paho starts its threads.
     */
    static final Duration ANSWERED_WITHIN = Duration.ofSeconds(15);

    /** Enough for 10,000 in a second; brokers drop what they are given faster than they can take it. */
    private static final int INFLIGHT = 100;

    private static final int COMMAND_QOS = 1;
    private static final int TOPICS_PER_SUBSCRIPTION = 100;
    private static final long CLOSE_MS = 100;
    private static final long RETRY_NANOS = TimeUnit.SECONDS.toNanos(1);
    private static final long STALLED_NANOS = TimeUnit.SECONDS.toNanos(10);

    private final MqttAccess access;
    private final MqttAccess.Login login;
    private final MqttAsyncClient client;
    private Outbox outbox;
    private final Queue<Long> acknowledgements = new ConcurrentLinkedQueue<>();
    private final BiConsumer<String, byte[]> heard;
    private final String[] topics;
    private volatile boolean closed;
    private long lastAttempt = System.nanoTime();
    private final Outage outage = new Outage(System::nanoTime);
    private Long watched;
    private long watchedSince;

    /**
     * What a line is for.
     *
     * @param login as whom to connect
     * @param name start of the client id; its end is random, so that two fleets do not evict each other
     * @param topics to listen to, again after each break
     * @param keptMessages how many may wait for the broker, at QoS 1
     * @param keptBytes of the memory that they may take, about
     */
    public record Plan(
            MqttAccess.Login login, String name, Collection<String> topics, int keptMessages, long keptBytes) {}

    private Line(MqttAccess access, Plan plan, MqttAsyncClient client, BiConsumer<String, byte[]> heard) {
        this.access = access;
        this.login = plan.login();
        this.outbox = new Outbox(plan.keptMessages(), plan.keptBytes());
        this.topics = plan.topics().toArray(String[]::new);
        this.client = client;
        this.heard = heard;
    }

    /**
     * Connects.
     *
     * @param heard is given topic and payload of what comes, on a thread of the client
     * @throws IOException naming broker and user, if the broker is away, refuses, or does not answer
     */
    public static Line open(MqttAccess access, Plan plan, BiConsumer<String, byte[]> heard) throws IOException {
        return open(access, plan, heard, ANSWERED_WITHIN);
    }

    static Line open(MqttAccess access, Plan plan, BiConsumer<String, byte[]> heard, Duration answeredWithin)
            throws IOException {
        String id = plan.name() + "-" + UUID.randomUUID().toString().substring(0, 8);
        boolean open = false;
        Line line = null;
        try {
            MqttAsyncClient client = new MqttAsyncClient(access.broker().toString(), id, new MemoryPersistence());
            line = new Line(access, plan, client, heard);
            client.setCallback(line);
            client.connect(line.options()).waitForCompletion(answeredWithin.toMillis());
            open = true;
            return line;
        } catch (MqttException e) {
            throw new IOException(access.refusal(plan.login(), e), e);
        } finally {
            if (!open && line != null) {
                line.close();
            }
        }
    }

    /** Sends what another line of the same device has not brought through yet; that one is not to be used any more. */
    public void takeOver(Line other) {
        outbox = other.outbox;
        outbox.broken();
    }

    /** Publishes a message, at once if the connection stands; with QoS 0 only then. */
    public void send(String topic, byte[] payload) {
        if (access.qos() == 1) {
            outbox.add(new Outbox.Message(topic, payload));
            push();
        } else if (ready()) {
            publish(topic, payload, 0, null);
        }
    }

    /** Sends what waits, and opens a broken connection again, trying once a second. */
    public void push() {
        for (Long number = acknowledgements.poll(); number != null; number = acknowledgements.poll()) {
            outbox.acknowledged(number);
        }
        breakOffWhereStalled();
        if (!ready()) {
            outbox.broken();
            return;
        }
        for (Map.Entry<Long, Outbox.Message> next = outbox.first();
                next != null && outbox.underWay() < INFLIGHT;
                next = outbox.first()) {
            Outbox.Message message = next.getValue();
            if (!publish(message.topic(), message.payload(), 1, new Acknowledgement(next.getKey()))) {
                return;
            }
            outbox.sent(next.getKey());
        }
    }

    /** A broker that has dropped a message acknowledges it only when the message comes again over another connection. */
    private void breakOffWhereStalled() {
        Long oldest = outbox.oldestUnderWay();
        if (oldest == null || !oldest.equals(watched)) {
            watched = oldest;
            watchedSince = System.nanoTime();
        } else if (System.nanoTime() - watchedSince > STALLED_NANOS) {
            LOG.warn("{} has a message that is not acknowledged, and connects again", this);
            watched = null;
            try {
                client.disconnectForcibly(0, CLOSE_MS, false);
            } catch (MqttException e) {
                LOG.debug("{} could not be broken off", this, e);
            }
        }
    }

    /** Messages that the broker has acknowledged, at QoS 1. */
    public long acknowledged() {
        return outbox.acknowledged();
    }

    /** Messages that it has not, at QoS 1. */
    public int open() {
        return outbox.open();
    }

    /** Messages that were given up because too many waited. */
    public long dropped() {
        return outbox.dropped();
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
            LOG.warn("{} hears no commands until it connects again", this, e);
        }
    }

    @Override
    public void connectionLost(Throwable cause) {
        outage.begin(this, cause.getMessage());
    }

    @Override
    public void messageArrived(String topic, MqttMessage message) {
        heard.accept(topic, message.getPayload());
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        // Each message has a listener of its own.
    }

    /** Disconnects within half a second or so, also when the broker hangs or is gone; a second time does nothing. */
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
            LOG.debug("{} could not say goodbye", this, e);
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
            LOG.debug("{} takes no message now", this, e);
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
        options.setMaxInflight(2 * INFLIGHT);
        options.setSocketFactory(access.isEncrypted() ? access.encryptedSockets() : new NoDelaySockets());
        return options;
    }

    /** Of one message; a message that fails is sent again when the connection stands again. */
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
            LOG.debug("{} has a message that did not arrive", Line.this, cause);
        }
    }
}
