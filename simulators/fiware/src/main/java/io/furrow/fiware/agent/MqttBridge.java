package io.furrow.fiware.agent;

import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.UUID;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;

import com.hivemq.client.mqtt.datatypes.MqttQos;
import com.hivemq.client.mqtt.lifecycle.MqttClientDisconnectedContext;
import com.hivemq.client.mqtt.lifecycle.MqttClientReconnector;
import com.hivemq.client.mqtt.mqtt3.Mqtt3AsyncClient;
import com.hivemq.client.mqtt.mqtt3.Mqtt3Client;
import com.hivemq.client.mqtt.mqtt3.Mqtt3ClientBuilder;
import com.hivemq.client.mqtt.mqtt3.message.publish.Mqtt3Publish;
import com.hivemq.client.mqtt.mqtt3.message.subscribe.Mqtt3Subscribe;
import com.hivemq.client.mqtt.mqtt3.message.subscribe.Mqtt3Subscription;
import com.hivemq.client.mqtt.mqtt3.message.subscribe.suback.Mqtt3SubAck;
import com.hivemq.client.mqtt.mqtt3.message.subscribe.suback.Mqtt3SubAckReturnCode;
import com.hivemq.client.mqtt.mqtt3.message.unsubscribe.Mqtt3Unsubscribe;
import io.reactivex.disposables.Disposable;
import io.reactivex.disposables.Disposables;
import io.reactivex.schedulers.Schedulers;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The MQTT client of the agent: subscribes to {@code /<apikey>/<device>/attrs} and {@code …/cmdexe}, also with the
 * prefix {@code /json}, and publishes {@code …/cmd} (QoS 0, as the agent's default). QoS 1 in a persistent session:
 * messages during a disconnect are delivered after it. Messages are processed in order and then acknowledged, so no
 * more wait here than the broker leaves unacknowledged.
 */
public final class MqttBridge implements IotAgent.Downlink, AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(MqttBridge.class);
    private static final Mqtt3Subscribe SUBSCRIBE = Mqtt3Subscribe.builder()
            .addSubscriptions(List.of("/+/+/attrs", "/json/+/+/attrs", "/+/+/cmdexe", "/json/+/+/cmdexe").stream()
                    .map(filter -> Mqtt3Subscription.builder()
                            .topicFilter(filter)
                            .qos(MqttQos.AT_LEAST_ONCE)
                            .build()))
            .build();
    private static final int DEFAULT_PORT = 1883;
    private static final int KEEP_ALIVE_SECONDS = 30;
    private static final long OPEN_SECONDS = 15;
    private static final long CLOSE_SECONDS = 1;
    private static final long FIRST_PAUSE_MS = 250;
    private static final long MAX_PAUSE_MS = 5_000;

    private enum Phase {
        OPENING,
        OPEN,
        CLOSED
    }

    private final URI broker;
    private final IotAgent agent;
    private final Mqtt3AsyncClient client;
    private final ExecutorService receiver = Executors.newSingleThreadExecutor(MqttBridge::receiverThread);
    private volatile Disposable messages = Disposables.disposed();
    private volatile Phase phase = Phase.OPENING;
    private volatile CompletableFuture<Void> pause = CompletableFuture.completedFuture(null);

    /**
     * @param broker {@code tcp://host:port}
     * @param user null without authentication
     * @throws IllegalStateException if the broker cannot be reached or refuses the user
     */
    public static MqttBridge open(URI broker, String user, String password, IotAgent agent) {
        MqttBridge bridge = new MqttBridge(broker, user, password, agent);
        try {
            bridge.connect();
            return bridge;
        } catch (CompletionException e) {
            bridge.close();
            throw new IllegalStateException(
                    "the IoT agent cannot use the MQTT broker at " + broker
                            + "; is it running, are user and password right?",
                    e.getCause());
        }
    }

    private MqttBridge(URI broker, String user, String password, IotAgent agent) {
        this.broker = broker;
        this.agent = agent;
        Mqtt3ClientBuilder builder = Mqtt3Client.builder()
                .identifier("furrow-iot-agent-" + UUID.randomUUID().toString().substring(0, 8))
                .serverHost(broker.getHost())
                .serverPort(broker.getPort() < 0 ? DEFAULT_PORT : broker.getPort())
                .executorConfig()
                .nettyThreads(1)
                // Messages go to a thread of our own at once, so the client needs no further one for them.
                .applicationScheduler(Schedulers.trampoline())
                .applyExecutorConfig()
                .addDisconnectedListener(this::disconnected);
        if (user != null) {
            builder = builder.simpleAuth()
                    .username(user)
                    .password(password.getBytes(StandardCharsets.UTF_8))
                    .applySimpleAuth();
        }
        client = builder.buildAsync();
    }

    @Override
    public boolean send(String apikey, String deviceId, byte[] command) {
        if (!client.getState().isConnected()) {
            LOG.warn("A command for device {} was not sent: no MQTT connection", deviceId);
            return false;
        }
        client.publishWith()
                .topic("/" + apikey + "/" + deviceId + "/cmd")
                .qos(MqttQos.AT_MOST_ONCE)
                .payload(command)
                .send()
                .exceptionally(failure -> {
                    LOG.warn("A command for device {} was lost: {}", deviceId, failure.toString());
                    return null;
                });
        return true;
    }

    @Override
    public void close() {
        phase = Phase.CLOSED;
        pause.complete(null);
        if (client.getState().isConnected()) {
            leave();
        }
        // Otherwise the client's thread would stay for messages of a connection that may be restored.
        messages.dispose();
        receiver.shutdown();
    }

    /** Unsubscribes, because the session outlives the connection and would collect messages. */
    private void leave() {
        client.unsubscribe(Mqtt3Unsubscribe.builder().reverse(SUBSCRIBE).build())
                .orTimeout(CLOSE_SECONDS, TimeUnit.SECONDS)
                .handle((left, failure) -> client.disconnect().orTimeout(CLOSE_SECONDS, TimeUnit.SECONDS))
                .thenCompose(disconnected -> disconnected)
                .exceptionally(failure -> {
                    LOG.debug("The MQTT connection was gone before it was closed", failure);
                    return null;
                })
                .join();
    }

    private void connect() {
        client.connectWith()
                .cleanSession(false)
                .keepAlive(KEEP_ALIVE_SECONDS)
                .send()
                .thenCompose(connected -> subscribe())
                .orTimeout(OPEN_SECONDS, TimeUnit.SECONDS)
                .join();
    }

    private CompletableFuture<Void> subscribe() {
        phase = Phase.OPEN;
        CompletableFuture<Mqtt3SubAck> acknowledged = new CompletableFuture<>();
        messages = client.toRx()
                .subscribePublishes(SUBSCRIBE, true)
                .doOnSingle(acknowledged::complete)
                .subscribe(this::received, acknowledged::completeExceptionally);
        return acknowledged.thenAccept(answer -> {
            if (answer.getReturnCodes().stream().anyMatch(Mqtt3SubAckReturnCode::isError)) {
                throw new IllegalStateException("the MQTT broker refuses the subscription");
            }
        });
    }

    /** Reconnects with exponential backoff; the very first connection is not retried. */
    private void disconnected(MqttClientDisconnectedContext context) {
        if (phase != Phase.OPEN) {
            return;
        }
        MqttClientReconnector reconnector = context.getReconnector();
        if (reconnector.getAttempts() == 0) {
            LOG.warn(
                    "The IoT agent lost its MQTT connection to {} and reconnects: {}",
                    broker,
                    context.getCause().toString());
        }
        long millis = Math.min(FIRST_PAUSE_MS << Math.min(reconnector.getAttempts(), 10), MAX_PAUSE_MS);
        pause = new CompletableFuture<Void>().completeOnTimeout(null, millis, TimeUnit.MILLISECONDS);
        reconnector.reconnectWhen(pause, (over, never) -> reconnector.reconnect(phase == Phase.OPEN));
    }

    private void received(Mqtt3Publish message) {
        receiver.execute(() -> {
            try {
                deliver(message);
            } finally {
                message.acknowledge();
            }
        });
    }

    private void deliver(Mqtt3Publish message) {
        String[] parts = message.getTopic().toString().substring(1).split("/");
        int first = parts.length - 3;
        if (parts[parts.length - 1].equals("attrs")) {
            agent.measured(parts[first], parts[first + 1], message.getPayloadAsBytes());
        } else {
            agent.executed(parts[first], parts[first + 1], message.getPayloadAsBytes());
        }
    }

    private static Thread receiverThread(Runnable work) {
        Thread thread = new Thread(work, "furrow-iot-agent-mqtt");
        thread.setDaemon(true);
        return thread;
    }
}
