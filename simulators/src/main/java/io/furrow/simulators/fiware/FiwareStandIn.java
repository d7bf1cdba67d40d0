package io.furrow.simulators.fiware;

import java.net.URI;
import java.time.Clock;
import java.util.ArrayDeque;
import java.util.Deque;

/**
 * An IoT agent and a context broker in this JVM: NGSI-v2 at {@link #contextBroker()}, provisioning at {@link #iotAgent()},
 * devices over MQTT. Both listen on 127.0.0.1 only and keep everything in memory.
 */
public final class FiwareStandIn implements AutoCloseable {
    private final Notifier notifier;
    private final IotAgent agent;
    private final LoopbackServer contextBroker;
    private final LoopbackServer iotAgent;
    /** Closed in the reverse order of their start. */
    private final Deque<Part> started = new ArrayDeque<>();

    private interface Part extends AutoCloseable {
        @Override
        void close();
    }

    /**
     * Starts all of it.
     *
     * @throws java.io.UncheckedIOException if a port is taken
     * @throws IllegalStateException if the MQTT broker cannot be used
     */
    public static FiwareStandIn start(FiwareSettings settings) {
        return start(settings, Clock.systemUTC());
    }

    /** With the clock that all dates are read from. */
    static FiwareStandIn start(FiwareSettings settings, Clock clock) {
        return new FiwareStandIn(settings, clock);
    }

    private FiwareStandIn(FiwareSettings settings, Clock clock) {
        DeviceRegistry registry = new DeviceRegistry();
        notifier = new Notifier(clock);
        agent = new IotAgent(registry);
        ContextBroker broker = new ContextBroker(notifier, agent, clock);
        agent.connect(broker);
        boolean complete = false;
        try {
            notifier.start();
            started.push(notifier::close);
            contextBroker = LoopbackServer.start(
                    "context-broker", settings.contextBrokerPort(), new ContextBrokerApi(broker, notifier));
            started.push(contextBroker::close);
            iotAgent = LoopbackServer.start("iot-agent", settings.iotAgentPort(), new IotAgentApi(registry, agent));
            started.push(iotAgent::close);
            if (settings.mqttBroker() != null) {
                MqttLink link = MqttLink.open(settings, agent);
                started.push(link::close);
                agent.connect(link);
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

    public FiwareCounters counters() {
        return new FiwareCounters(
                agent.measures(),
                agent.refused(),
                notifier.sent(),
                notifier.failed(),
                notifier.dropped(),
                notifier.queued());
    }

    /** Sends nothing more and stops all threads; a second call does nothing. */
    @Override
    public synchronized void close() {
        while (!started.isEmpty()) {
            started.pop().close();
        }
    }
}
