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
import io.furrow.simulators.device.IotAgent;
import io.furrow.simulators.scenario.Farm;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;

/**
 * A farm at work: connected and reporting until closed, its devices all there from the start or coming and going. One thread
 * runs all devices; it never waits for an answer. A measure is of the time at which it was due, though it may be sent a little
 * later.
 */
public final class FarmFleet implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(FarmFleet.class);
    private static final Duration LOOK = Duration.ofMillis(10);

    private final Clock clock;
    private final Scene scene = new Scene();
    private final Timetable timetable = new Timetable();
    private final Queue<Runnable> changes = new ConcurrentLinkedQueue<>();
    private final Connections connections;
    private final LineOpener opener = new LineOpener();
    private final LineOpener.Outcome openings = new Openings();
    private final Map<String, Member> joining = new HashMap<>();
    private final FleetEvents events;
    private final Robots robots;
    private final Commands commands;
    private final LongAdder reports = new LongAdder();
    private final Thread thread = new Thread(this::run, "simulated-farm");
    private volatile Tally tally = new Tally(0, 0, 0);
    private volatile long steps;
    private volatile boolean draining;
    private volatile boolean closed;

    /**
     * A device that joins a fleet.
     *
     * @param scope of its entity
     * @param since when it set out on its way
     */
    public record Member(SimulatedDevice device, FiwareScope scope, Instant since) {}

    /**
     * What became of the measures at QoS 1.
     *
     * @param acknowledged by the MQTT broker
     * @param open sent or waiting, and not acknowledged
     * @param dropped given up because too many waited
     */
    public record Tally(long acknowledged, long open, long dropped) {}

    private FarmFleet(FleetAccess access, Connections connections, FleetEvents events, Clock clock) {
        this.clock = clock;
        this.connections = connections;
        this.events = events;
        this.robots = new Robots(access.fiware(), scene, events);
        this.commands = new Commands(scene, connections, this::send);
        thread.setDaemon(true);
    }

    /**
     * Provisions the farm's devices at the IoT Agent, connects them and lets them report. Up to 500 MQTT devices have a
     * connection of their own; of more each mission has a gateway.
     *
     * @throws IOException if the IoT Agent or the MQTT broker is away or refuses; nothing is left running then
     */
    public static FarmFleet start(Farm farm, FleetAccess access) throws IOException, InterruptedException {
        new IotAgent(access.fiware()).provision(farm.apiKey(), Registrations.of(farm));
        return start(farm, access, Connections.MOST_OWN, Clock.systemUTC());
    }

    /** The same of devices that are provisioned. */
    static FarmFleet start(Farm farm, FleetAccess access, int mostOwn, Clock clock) throws IOException {
        Connections connections = new Connections(access, mission -> farm.apiKey(), mostOwn);
        FarmFleet fleet = new FarmFleet(access, connections, FleetEvents.NONE, clock);
        FiwareScope scope = Robots.scope(access.fiware());
        Instant start = clock.instant();
        boolean open = false;
        try {
            List<SimulatedDevice> devices = farm.devices();
            for (Connections.Way way : connections.add(SimulatedDevice.overMqtt(devices))) {
                way.open();
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
     * A fleet whose devices come and go. They are provisioned by somebody else: a refused connection is tried again for as long
     * as the device is wanted.
     *
     * @param apiKeys of missions, first part of the MQTT topics of their devices
     */
    public static FarmFleet open(FleetAccess access, UnaryOperator<String> apiKeys, FleetEvents events) {
        return open(access, new Connections(access, apiKeys, Connections.MOST_OWN), events);
    }

    static FarmFleet open(FleetAccess access, Connections connections, FleetEvents events) {
        FarmFleet fleet = new FarmFleet(access, connections, events, Clock.systemUTC());
        fleet.thread.start();
        return fleet;
    }

    /** Lets devices of one mission join, none of which is there; each reports once it is connected, and from then on. */
    public void add(Collection<Member> members) {
        List<Member> joining = List.copyOf(members);
        changes.add(() -> join(joining));
    }

    /** Takes a device away; what it has not sent yet is not sent. Nothing happens where it is not there. */
    public void remove(String device) {
        changes.add(() -> {
            joining.remove(device);
            timetable.remove(device);
            scene.remove(device);
            robots.remove(device);
            commands.remove(device);
            connections.remove(device).forEach(opener::close);
        });
    }

    /** Takes up logins and API keys as they are now; a device goes on with what it has until the MQTT broker takes the new. */
    public void renew() {
        changes.add(() -> connections.renew().forEach(way -> opener.open(way, openings)));
    }

    /** How many reports have been made since the start. */
    public long reports() {
        return reports.sum();
    }

    /** How many MQTT connections it has. */
    public int connections() {
        return connections.count();
    }

    /** As of some hundredths of a second ago. */
    public Tally tally() {
        return tally;
    }

    /**
     * Lets devices report no more and waits until the MQTT broker has acknowledged what they reported.
     *
     * @return whether it has within that time
     */
    public boolean drain(Duration patience) throws InterruptedException {
        draining = true;
        long begun = steps;
        long end = System.nanoTime() + patience.toNanos();
        // Two steps on, none is under way that began before.
        while (steps < begun + 2 || tally.open() > 0) {
            if (System.nanoTime() > end) {
                return false;
            }
            TimeUnit.NANOSECONDS.sleep(LOOK.toNanos());
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
                LOG.error("a simulated device broke down in one report", e);
            }
            Instant now = clock.instant();
            Instant next = draining ? now.plus(LOOK) : timetable.next().orElse(now.plus(LOOK));
            long wait = Math.min(LOOK.toNanos(), Duration.between(now, next).toNanos());
            if (wait > 0 && !closed) {
                LockSupport.parkNanos(wait);
            }
        }
    }

    private void step() {
        for (Runnable change = changes.poll(); change != null; change = changes.poll()) {
            change.run();
        }
        Instant now = clock.instant();
        commands.obey(now);
        robots.obey(now);
        for (Optional<Timetable.Due> due = draining ? Optional.empty() : timetable.take(now);
                due.isPresent() && !closed && !draining;
                due = timetable.take(now)) {
            scene.report(due.get().device(), due.get().time()).ifPresent(this::send);
        }
        connections.change().forEach(opener::close);
        connections.push();
        tally = connections.tally();
        steps = steps + 1;
        robots.ask(now);
    }

    private void join(List<Member> members) {
        Instant now = clock.instant();
        Collection<Connections.Way> fresh = connections.add(
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
        fresh.forEach(way -> opener.open(way, openings));
    }

    /** Lets a device that has a connection say its first word at once. */
    private void begin(String id, Instant now) {
        Member member = joining.remove(id);
        if (member != null) {
            admit(member, now);
            scene.report(member.device(), now).ifPresent(this::send);
        }
    }

    private void admit(Member member, Instant now) {
        SimulatedDevice device = member.device();
        scene.add(device, member.since(), now);
        timetable.add(device, now);
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

    /** What becomes of connections, told on threads of the opener. */
    private final class Openings implements LineOpener.Outcome {
        @Override
        public void opened(Connections.Way way) {
            changes.add(() -> way.devices().forEach(id -> {
                if (joining.containsKey(id)) {
                    begin(id, clock.instant());
                    events.up(id);
                }
            }));
        }

        @Override
        public void failed(Connections.Way way, int attempts, String reason) {
            changes.add(() -> way.devices().forEach(id -> events.failed(id, attempts, reason)));
        }
    }
}
