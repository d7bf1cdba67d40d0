package io.furrow.fiware;

import java.net.URI;
import java.time.Clock;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.concurrent.atomic.AtomicLong;

import io.furrow.fiware.agent.DeviceRegistry;
import io.furrow.fiware.agent.IotAgent;
import io.furrow.fiware.agent.IotAgentApi;
import io.furrow.fiware.agent.MeasureHistory;
import io.furrow.fiware.agent.MqttBridge;
import io.furrow.fiware.api.NgsiV2Api;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.Notifier;
import io.furrow.fiware.http.LoopbackServer;

/**
 * Runs an IoT agent and a context broker in this JVM: NGSI-v2 at {@link #contextBroker()}, provisioning at {@link
 * #iotAgent()}, devices over MQTT. Both listen on 127.0.0.1 only and work in memory; a state file preserves their state
 * across restarts.
 */
public final class FiwareStandIn implements AutoCloseable {
    private final Notifier notifier;
    private final IotAgent agent;
    private final MeasureHistory history;
    private final LoopbackServer contextBroker;
    private final LoopbackServer iotAgent;
    /** Closed in the reverse order of their start. */
    private final Deque<Runnable> started = new ArrayDeque<>();

    /**
     * Starts a stand-in.
     *
     * @throws java.io.UncheckedIOException if a port is in use or the state file cannot be read
     * @throws IllegalStateException if the MQTT broker cannot be used or the state file is damaged
     */
    public static FiwareStandIn start(FiwareSettings settings) {
        return start(settings, Clock.systemUTC());
    }

    /** With a clock for all dates. */
    static FiwareStandIn start(FiwareSettings settings, Clock clock) {
        return new FiwareStandIn(settings, clock);
    }

    private FiwareStandIn(FiwareSettings settings, Clock clock) {
        AtomicLong revision = new AtomicLong();
        DeviceRegistry registry = new DeviceRegistry(revision, clock);
        notifier = new Notifier(clock, settings.connections() == FiwareSettings.Connections.PERSISTENT);
        history = new MeasureHistory(clock);
        agent = new IotAgent(registry, history);
        ContextBroker broker = new ContextBroker(notifier, agent, clock, revision);
        agent.connect(broker);
        boolean complete = false;
        try {
            if (settings.state() != null) {
                StateCodec state = new StateCodec(broker, registry, revision);
                started.push(PersistentState.open(settings.state(), state, revision)::close);
            }
            notifier.start();
            started.push(notifier::close);
            contextBroker = LoopbackServer.start(
                    "context-broker",
                    settings.contextBrokerPort(),
                    settings.allowed(),
                    new NgsiV2Api(broker, notifier));
            started.push(contextBroker::close);
            iotAgent = LoopbackServer.start(
                    "iot-agent", settings.iotAgentPort(), settings.allowed(), new IotAgentApi(registry));
            started.push(iotAgent::close);
            if (settings.mqttBroker() != null) {
                MqttBridge bridge =
                        MqttBridge.open(settings.mqttBroker(), settings.mqttUser(), settings.mqttPassword(), agent);
                started.push(bridge::close);
                agent.connect(bridge);
            }
            complete = true;
        } finally {
            if (!complete) {
                close();
            }
        }
    }

    /** {@code http://127.0.0.1:<port>}, to which {@code /v2/…} is appended. */
    public URI contextBroker() {
        return contextBroker.uri();
    }

    /** {@code http://127.0.0.1:<port>}, to which {@code /iot/…} is appended. */
    public URI iotAgent() {
        return iotAgent.uri();
    }

    /** The measures that the IoT agent received. */
    public MeasureHistory history() {
        return history;
    }

    public FiwareCounters counters() {
        return new FiwareCounters(
                agent.measures(),
                agent.refused(),
                notifier.sent(),
                notifier.failed(),
                notifier.dropped(),
                notifier.queued());
    }

    /** Stops sending and all threads, and writes the state; a second call does nothing. */
    @Override
    public synchronized void close() {
        while (!started.isEmpty()) {
            started.pop().run();
        }
    }
}
