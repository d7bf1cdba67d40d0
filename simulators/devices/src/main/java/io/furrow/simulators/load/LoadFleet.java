package io.furrow.simulators.load;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;
import java.util.stream.IntStream;

import io.furrow.simulators.device.DeviceRegistration;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.device.IotAgentClient;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.mqtt.MqttConnection;

/**
 * Sends a load: the devices of a plan, evenly phased, over {@value #GATEWAYS} MQTT connections. The schedule is
 * absolute: late messages are sent as soon as possible and none is skipped; {@code time} in a message is the actual
 * time of sending.
 */
public final class LoadFleet implements AutoCloseable {
    private static final String API_KEY = "furrow-load";
    private static final int GATEWAYS = 4;
    private static final int MAX_INFLIGHT = 2_000;
    private static final int MIN_INFLIGHT = 16;
    private static final int INFLIGHT_BYTES = 16 * 1024 * 1024;
    private static final long PUSH_INTERVAL_NANOS = TimeUnit.MICROSECONDS.toNanos(500);
    private static final long POLL_INTERVAL_MS = 5;
    private static final Duration TIMEOUT = Duration.ofSeconds(30);

    private final LoadPlan plan;
    private final int inflight;
    private final List<MqttConnection> gateways = new ArrayList<>();
    private final LoadMessages messages;
    private final Thread pacer = new Thread(this::pace, "load");
    private volatile boolean closed;
    private volatile long sent;
    private volatile long acknowledged;
    private volatile long held;
    private volatile boolean holding;

    private LoadFleet(LoadPlan plan) {
        this.plan = plan;
        this.inflight = Math.max(MIN_INFLIGHT, Math.min(MAX_INFLIGHT, INFLIGHT_BYTES / plan.payloadBytes()));
        this.messages = new LoadMessages(plan.payloadBytes(), System.currentTimeMillis());
        pacer.setDaemon(true);
    }

    /**
     * Provisions the devices; the context broker notifies of each new one before any measure.
     *
     * @throws IOException if the IoT Agent is unavailable or refuses
     */
    public static void provision(FleetSettings settings, LoadPlan plan) throws IOException, InterruptedException {
        new IotAgentClient(settings)
                .provision(
                        API_KEY,
                        IntStream.range(0, plan.devices())
                                .mapToObj(device -> registration(plan, device))
                                .toList());
    }

    /**
     * Connects the provisioned devices and starts to send.
     *
     * @throws IOException if the MQTT broker is unavailable or refuses; nothing keeps running then
     */
    public static LoadFleet start(FleetSettings settings, LoadPlan plan) throws IOException {
        MqttAccess access = new MqttAccess(settings.mqtt(), null, 1);
        MqttAccess.Login login = new MqttAccess.Login(settings.mqttUser(), settings.mqttPassword());
        LoadFleet fleet = new LoadFleet(plan);
        boolean started = false;
        try {
            for (int i = 0; i < Math.min(GATEWAYS, plan.devices()); i++) {
                fleet.gateways.add(MqttConnection.open(access, fleet.connection(login), (topic, payload) -> {}));
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

    private MqttConnection.Plan connection(MqttAccess.Login login) {
        return new MqttConnection.Plan(login, "load-gateway", List.of(), inflight, Long.MAX_VALUE, inflight);
    }

    /** Messages handed to the connections. */
    public long sent() {
        return sent;
    }

    /** Messages acknowledged by the MQTT broker. */
    public long acknowledged() {
        return acknowledged;
    }

    /** Messages that had to wait because too many were unacknowledged. */
    public long held() {
        return held;
    }

    /**
     * Waits until every message of the plan is sent and acknowledged.
     *
     * @throws IOException if it was closed, or made no progress for 30 s
     */
    public void await() throws IOException, InterruptedException {
        long moved = System.nanoTime();
        long before = -1;
        while (acknowledged() < plan.messages()) {
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
            long now = sent + acknowledged();
            boolean idle = !holding && sent == acknowledged();
            if (!closed && (idle || now != before)) {
                before = now;
                moved = System.nanoTime();
            } else if (closed || System.nanoTime() - moved > TIMEOUT.toNanos()) {
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
        gateways.parallelStream().forEach(MqttConnection::close);
    }

    private void pace() {
        long start = System.nanoTime();
        long period = plan.period().toNanos();
        for (long i = 0; i < plan.messages() && !closed; i++) {
            int device = (int) (i % plan.devices());
            long sequence = i / plan.devices();
            waitUntil(start + sequence * period + period * device / plan.devices());
            send(device, sequence);
        }
        while (acknowledged < sent && !closed) {
            pause(PUSH_INTERVAL_NANOS);
        }
    }

    private void waitUntil(long due) {
        for (long left = due - System.nanoTime(); left > 0 && !closed; left = due - System.nanoTime()) {
            pause(Math.min(left, PUSH_INTERVAL_NANOS));
        }
    }

    /** Waits, then takes acknowledgements and reconnects broken connections. */
    private void pause(long nanos) {
        LockSupport.parkNanos(nanos);
        gateways.forEach(MqttConnection::push);
        acknowledged = gateways.stream().mapToLong(MqttConnection::acknowledged).sum();
    }

    private void send(int device, long sequence) {
        // A device always uses the same connection, which preserves its order.
        MqttConnection gateway = gateways.get(device % gateways.size());
        while (gateway.open() >= inflight && !closed) {
            held += holding ? 0 : 1;
            holding = true;
            pause(PUSH_INTERVAL_NANOS);
        }
        if (!closed) {
            gateway.send(
                    "/" + API_KEY + "/" + id(plan, device) + "/attrs",
                    messages.message(device, sequence, System.currentTimeMillis()));
            sent++;
            holding = false;
        }
    }

    private static DeviceRegistration registration(LoadPlan plan, int device) {
        return new DeviceRegistration(
                id(plan, device),
                new DeviceRegistration.Entity("urn:ngsi-ld:Device:" + id(plan, device), "Device"),
                List.of(
                        new DeviceRegistration.Attribute("time", "Time", "Integer"),
                        new DeviceRegistration.Attribute("stat", "Status", "Boolean"),
                        new DeviceRegistration.Attribute("payload", "Payload", "String")),
                new DeviceRegistration.MissionOf(plan.domain(), plan.mission()),
                List.of());
    }

    private static String id(LoadPlan plan, int device) {
        return String.format(Locale.ROOT, "%s-%05d", plan.mission(), device);
    }
}
