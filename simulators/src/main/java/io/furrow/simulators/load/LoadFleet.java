package io.furrow.simulators.load;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;
import java.util.stream.IntStream;

import org.eclipse.paho.client.mqttv3.MqttException;

import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.device.IotAgent;
import io.furrow.simulators.device.Registration;

/**
 * A load under way: the devices of a plan, evenly phased, over {@value #GATEWAYS} MQTT connections. The schedule is
 * absolute: what could not be sent in time is sent as soon as possible and nothing is left out; {@code time} in a message
 * is when it was really sent.
 */
public final class LoadFleet implements AutoCloseable {
    private static final String API_KEY = "furrow-load";
    private static final int GATEWAYS = 4;
    private static final int MOST_INFLIGHT = 2_000;
    private static final int LEAST_INFLIGHT = 16;
    private static final int INFLIGHT_BYTES = 16 * 1024 * 1024;
    private static final long RETRY_NANOS = TimeUnit.MICROSECONDS.toNanos(500);
    private static final long LOOK_MS = 5;
    private static final Duration PATIENCE = Duration.ofSeconds(30);

    private final LoadPlan plan;
    private final List<Gateway> gateways = new ArrayList<>();
    private final LoadMessages messages;
    private final Thread pacer = new Thread(this::pace, "load");
    private volatile boolean closed;
    private volatile long sent;
    private volatile long held;
    private volatile boolean holding;
    private volatile MqttException broken;

    private LoadFleet(LoadPlan plan) {
        this.plan = plan;
        this.messages = new LoadMessages(plan.payloadBytes(), System.currentTimeMillis());
        pacer.setDaemon(true);
    }

    /**
     * Provisions the devices; the context broker tells each new one as a change of its own, before any measure.
     *
     * @throws IOException if the IoT Agent is away or refuses
     */
    public static void provision(FleetSettings settings, LoadPlan plan) throws IOException, InterruptedException {
        new IotAgent(settings)
                .provision(
                        API_KEY,
                        IntStream.range(0, plan.devices())
                                .mapToObj(device -> registration(plan, device))
                                .toList());
    }

    /**
     * Connects the provisioned devices and starts to send.
     *
     * @throws IOException if the MQTT broker is away or refuses; nothing is left running then
     */
    public static LoadFleet start(FleetSettings settings, LoadPlan plan) throws IOException {
        int inflight = Math.max(LEAST_INFLIGHT, Math.min(MOST_INFLIGHT, INFLIGHT_BYTES / plan.payloadBytes()));
        LoadFleet fleet = new LoadFleet(plan);
        boolean started = false;
        try {
            for (int i = 0; i < Math.min(GATEWAYS, plan.devices()); i++) {
                fleet.gateways.add(Gateway.connect(settings, "load-gateway", inflight));
            }
            fleet.pacer.start();
            started = true;
            return fleet;
        } finally {
            if (!started) {
                fleet.close();
            }
        }
    }

    /** How many messages have been handed to the connections. */
    public long sent() {
        return sent;
    }

    /** How many of them the MQTT broker has acknowledged. */
    public long acknowledged() {
        return gateways.stream().mapToLong(Gateway::acknowledged).sum();
    }

    /** How many had to wait because too many were unacknowledged or the connection was broken. */
    public long held() {
        return held;
    }

    /**
     * Waits until every message of the plan is sent and acknowledged.
     *
     * @throws IOException if sending broke down, or for 30 s nothing moved while messages were open
     */
    public void await() throws IOException, InterruptedException {
        long moved = System.nanoTime();
        long before = -1;
        while (acknowledged() < plan.messages()) {
            TimeUnit.MILLISECONDS.sleep(LOOK_MS);
            if (broken != null) {
                throw new IOException("the load broke down after " + sent + " messages", broken);
            }
            long now = sent + acknowledged();
            boolean idle = !holding && sent == acknowledged();
            if (!closed && (idle || now != before)) {
                before = now;
                moved = System.nanoTime();
            } else if (closed || System.nanoTime() - moved > PATIENCE.toNanos()) {
                throw new IOException("of %d messages %d were sent and %d acknowledged, then %s"
                        .formatted(plan.messages(), sent, acknowledged(), closed ? "it was closed" : "nothing moved"));
            }
        }
    }

    /** Stops sending and disconnects. */
    @Override
    public void close() {
        closed = true;
        LockSupport.unpark(pacer);
        gateways.parallelStream().forEach(Gateway::close);
    }

    private void pace() {
        long start = System.nanoTime();
        long period = plan.period().toNanos();
        try {
            for (long i = 0; i < plan.messages() && !closed; i++) {
                int device = (int) (i % plan.devices());
                long sequence = i / plan.devices();
                waitUntil(start + sequence * period + period * device / plan.devices());
                send(device, sequence);
            }
            while (acknowledged() < sent && !closed) {
                gateways.forEach(Gateway::ready);
                LockSupport.parkNanos(RETRY_NANOS);
            }
        } catch (MqttException e) {
            broken = e;
        }
    }

    private void waitUntil(long due) {
        for (long left = due - System.nanoTime(); left > 0 && !closed; left = due - System.nanoTime()) {
            LockSupport.parkNanos(left);
        }
    }

    private void send(int device, long sequence) throws MqttException {
        // A device keeps to one gateway, which keeps its messages in order.
        Gateway gateway = gateways.get(device % gateways.size());
        String topic = "/" + API_KEY + "/" + id(plan, device) + "/attrs";
        while (!closed) {
            if (gateway.offer(topic, messages.message(device, sequence, System.currentTimeMillis()))) {
                sent++;
                holding = false;
                return;
            }
            held += holding ? 0 : 1;
            holding = true;
            LockSupport.parkNanos(RETRY_NANOS);
        }
    }

    private static Registration registration(LoadPlan plan, int device) {
        return new Registration(
                id(plan, device),
                new Registration.Entity("urn:ngsi-ld:Device:" + id(plan, device), "Device"),
                List.of(
                        new Registration.Attribute("time", "Time", "Integer"),
                        new Registration.Attribute("stat", "Status", "Boolean"),
                        new Registration.Attribute("payload", "Payload", "String")),
                new Registration.MissionOf(plan.domain(), plan.mission()),
                List.of());
    }

    private static String id(LoadPlan plan, int device) {
        return "%s-%05d".formatted(plan.mission(), device);
    }
}
