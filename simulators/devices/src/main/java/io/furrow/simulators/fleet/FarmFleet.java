package io.furrow.simulators.fleet;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.LongAdder;
import java.util.concurrent.locks.LockSupport;
import java.util.function.UnaryOperator;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.event.FiwareScope;
import io.furrow.simulators.device.IotAgentClient;
import io.furrow.simulators.scenario.Farm;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;

/**
 * Runs simulated devices until closed, all from the start or as they are added and removed. One thread runs all devices
 * and never waits for an answer. A measure carries the time at which it was due, though it may be sent a little later.
 */
public final class FarmFleet implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(FarmFleet.class);
    private static final Duration POLL_INTERVAL = Duration.ofMillis(10);
    private static final Duration POLL_INTERVAL_WITHOUT_DEVICES = Duration.ofMillis(100);

    private final Clock clock;
    private final FarmSimulation simulation = new FarmSimulation();
    private final ReportScheduler scheduler = new ReportScheduler();
    private final Queue<Runnable> changes = new ConcurrentLinkedQueue<>();
    private final Connections connections;
    private final ConnectionOpener opener = new ConnectionOpener();
    private final ConnectionOpener.Outcome openings = new Openings();
    private final Map<String, Member> joining = new HashMap<>();
    private final FleetEvents events;
    private final Robots robots;
    private final DeviceCommandExecutor commands;
    private final LongAdder reports = new LongAdder();
    private final Thread thread = new Thread(this::run, "simulated-farm");
    private volatile Tally tally = new Tally(0, 0, 0);
    private volatile long steps;
    private volatile boolean draining;
    private volatile boolean closed;

    /**
     * A device to add.
     *
     * @param scope of its entity
     * @param since start of its way
     */
    public record Member(SimulatedDevice device, FiwareScope scope, Instant since) {}

    /**
     * Counts of measures at QoS 1.
     *
     * @param acknowledged by the MQTT broker
     * @param open sent or waiting, and not acknowledged
     * @param dropped because too many waited
     */
    public record Tally(long acknowledged, long open, long dropped) {}

    private FarmFleet(FleetAccess access, Connections connections, FleetEvents events, Clock clock) {
        this.clock = clock;
        this.connections = connections;
        this.events = events;
        this.robots = new Robots(access.fiware(), simulation, events);
        this.commands = new DeviceCommandExecutor(simulation, connections, this::send);
        thread.setDaemon(true);
    }

    /**
     * Provisions the farm's devices at the IoT Agent, connects and starts them. Up to 500 MQTT devices have their own
     * connections; of more, each mission has a gateway.
     *
     * @throws IOException if the IoT Agent or the MQTT broker is unavailable or refuses; nothing keeps running then
     */
    public static FarmFleet start(Farm farm, FleetAccess access) throws IOException, InterruptedException {
        new IotAgentClient(access.fiware()).provision(farm.apiKey(), DeviceRegistrationFactory.of(farm));
        return start(farm, access, Connections.MAX_OWN, Clock.systemUTC());
    }

    /** Starts provisioned devices. */
    static FarmFleet start(Farm farm, FleetAccess access, int maxOwn, Clock clock) throws IOException {
        Connections connections = new Connections(access, mission -> farm.apiKey(), maxOwn);
        FarmFleet fleet = new FarmFleet(access, connections, new FleetEvents() {}, clock);
        FiwareScope scope = Robots.scope(access.fiware());
        Instant start = clock.instant();
        boolean open = false;
        try {
            List<SimulatedDevice> devices = farm.devices();
            for (Connections.Channel channel : connections.add(SimulatedDevice.overMqtt(devices))) {
                channel.open();
            }
            devices.forEach(device -> fleet.admit(new Member(device, scope, start), start));
            fleet.thread.start();
            open = true;
            return fleet;
        } finally {
            if (!open) {
                fleet.close();
            }
        }
    }

    /**
     * Opens a fleet without devices, to which provisioned ones are added. A refused connection is retried until its
     * device is removed.
     *
     * @param apiKeys of missions, first part of the MQTT topics of their devices
     */
    public static FarmFleet open(FleetAccess access, UnaryOperator<String> apiKeys, FleetEvents events) {
        return open(access, new Connections(access, apiKeys, Connections.MAX_OWN), events);
    }

    static FarmFleet open(FleetAccess access, Connections connections, FleetEvents events) {
        FarmFleet fleet = new FarmFleet(access, connections, events, Clock.systemUTC());
        fleet.thread.start();
        return fleet;
    }

    /** Adds devices of one mission, none of which exists; each reports as soon as it is connected. */
    public void add(Collection<Member> members) {
        List<Member> joining = List.copyOf(members);
        changes.add(() -> join(joining));
    }

    /** Removes a device and its unsent measures; an unknown device is ignored. */
    public void remove(String device) {
        changes.add(() -> {
            joining.remove(device);
            scheduler.remove(device);
            simulation.remove(device);
            robots.remove(device);
            commands.remove(device);
            connections.remove(device).forEach(opener::close);
        });
    }

    /** Renews logins and API keys; a device uses the old ones until the MQTT broker accepts the new. */
    public void renew() {
        changes.add(() -> connections.renew().forEach(channel -> opener.open(channel, openings)));
    }

    /** Number of reports since the start. */
    public long reports() {
        return reports.sum();
    }

    /** Number of open MQTT connections. */
    public int connections() {
        return connections.count();
    }

    /** The counts, some hundredths of a second old. */
    public Tally tally() {
        return tally;
    }

    /**
     * Stops reports and waits until the MQTT broker has acknowledged all measures.
     *
     * @return false on timeout
     */
    public boolean drain(Duration timeout) throws InterruptedException {
        draining = true;
        long begun = steps;
        long end = System.nanoTime() + timeout.toNanos();
        // After two steps, no step that started before is running.
        while (steps < begun + 2 || tally.open() > 0) {
            if (System.nanoTime() > end) {
                return false;
            }
            TimeUnit.NANOSECONDS.sleep(POLL_INTERVAL.toNanos());
        }
        return true;
    }

    /** Stops all devices within seconds, also when the MQTT broker does not answer. */
    @Override
    public void close() {
        closed = true;
        LockSupport.unpark(thread);
        try {
            thread.join(Duration.ofSeconds(5).toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        opener.close();
        connections.close();
    }

    private void run() {
        while (!closed) {
            try {
                step();
            } catch (RuntimeException e) {
                // One device's fault must not stop all others.
                LOG.error("a simulated device failed in one report", e);
            }
            long wait = draining
                    ? POLL_INTERVAL.toNanos()
                    : scheduler.next().map(this::untilDue).orElse(POLL_INTERVAL_WITHOUT_DEVICES.toNanos());
            if (wait > 0 && !closed) {
                LockSupport.parkNanos(wait);
            }
        }
    }

    private long untilDue(Instant next) {
        return Math.min(
                POLL_INTERVAL.toNanos(), Duration.between(clock.instant(), next).toNanos());
    }

    private void step() {
        for (Runnable change = changes.poll(); change != null; change = changes.poll()) {
            change.run();
        }
        Instant now = clock.instant();
        commands.obey(now);
        robots.obey(now);
        for (Optional<ReportScheduler.Due> due = draining ? Optional.empty() : scheduler.take(now);
                due.isPresent() && !closed && !draining;
                due = scheduler.take(now)) {
            simulation.report(due.get().device(), due.get().time()).ifPresent(this::send);
        }
        connections.change().forEach(opener::close);
        connections.push();
        tally = connections.tally();
        steps = steps + 1;
        robots.poll(now);
    }

    private void join(List<Member> members) {
        Instant now = clock.instant();
        Collection<Connections.Channel> fresh = connections.add(
                SimulatedDevice.overMqtt(members.stream().map(Member::device).toList()));
        for (Member member : members) {
            String id = member.device().id();
            joining.put(id, member);
            if (member.device() instanceof Robot) {
                begin(id, now);
            } else if (connections.of(id).orElseThrow().isOpen()) {
                begin(id, now);
                events.up(id);
            }
        }
        fresh.forEach(channel -> opener.open(channel, openings));
    }

    /** Starts a connected device with a first report. */
    private void begin(String id, Instant now) {
        Member member = joining.remove(id);
        if (member != null) {
            admit(member, now);
            simulation.report(member.device(), now).ifPresent(this::send);
        }
    }

    private void admit(Member member, Instant now) {
        SimulatedDevice device = member.device();
        simulation.add(device, member.since(), now);
        scheduler.add(device, now);
        commands.add(device);
        if (device instanceof Robot robot) {
            robots.add(robot, member.scope());
        }
    }

    private void send(Report report) {
        reports.increment();
        if (report instanceof Report.Update update) {
            robots.send(update);
        } else if (report instanceof Report.Measures measures) {
            connections.send(measures.device(), "attrs", measures.json());
        }
    }

    /** Receives outcomes of connections, on threads of the opener. */
    private final class Openings implements ConnectionOpener.Outcome {
        @Override
        public void opened(Connections.Channel channel) {
            changes.add(() -> channel.devices().forEach(id -> {
                if (joining.containsKey(id)) {
                    begin(id, clock.instant());
                    events.up(id);
                }
            }));
        }

        @Override
        public void failed(Connections.Channel channel, int attempts, String reason) {
            changes.add(() -> channel.devices().forEach(id -> events.failed(id, attempts, reason)));
        }
    }
}
