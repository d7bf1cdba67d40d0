package io.furrow.simulators.fleet;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.LongAdder;
import java.util.concurrent.locks.LockSupport;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.device.IotAgent;
import io.furrow.simulators.robot.Command;
import io.furrow.simulators.scenario.Farm;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;

/**
 * A farm at work: provisioned, connected and reporting until closed. One thread runs all devices; it never waits for an answer. A
 * measure is of the time at which it was due, though it may be sent a little later.
 */
public final class FarmFleet implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(FarmFleet.class);
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final Duration LOOK = Duration.ofMillis(10);
    private static final Duration ASK = Duration.ofMillis(500);

    private final Clock clock;
    private final Map<String, SimulatedDevice> devices = new HashMap<>();
    private final Map<String, Robot> robotsByEntity = new HashMap<>();
    private final Scene scene;
    private final Timetable timetable = new Timetable();
    private final Queue<Heard> heard = new ConcurrentLinkedQueue<>();
    private final RobotLink robots;
    private final LongAdder reports = new LongAdder();
    private final Thread thread = new Thread(this::run, "simulated-farm");
    private Connections connections;
    private Instant asked = Instant.MIN;
    private volatile Tally tally = new Tally(0, 0, 0);
    private volatile long steps;
    private volatile boolean draining;
    private volatile boolean closed;

    /** A command that came over MQTT. */
    private record Heard(String device, byte[] payload) {}

    /**
     * What became of the measures at QoS 1.
     *
     * @param acknowledged by the MQTT broker
     * @param open sent or waiting, and not acknowledged
     * @param dropped given up because too many waited
     */
    public record Tally(long acknowledged, long open, long dropped) {}

    private FarmFleet(Farm farm, FleetAccess access, Clock clock) {
        this.clock = clock;
        Instant start = clock.instant();
        this.scene = new Scene(start);
        this.robots = new RobotLink(access.fiware());
        for (SimulatedDevice device : farm.devices()) {
            devices.put(device.id(), device);
            scene.add(device, start);
            timetable.add(device, start);
            if (device instanceof Robot robot) {
                robotsByEntity.put(device.identity().entity(), robot);
            }
        }
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
        FarmFleet fleet = new FarmFleet(farm, access, clock);
        fleet.connections = Connections.open(
                farm, access, mostOwn, (device, payload) -> fleet.heard.add(new Heard(device, payload)));
        fleet.thread.start();
        return fleet;
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
        for (Heard order = heard.poll(); order != null; order = heard.poll()) {
            obey(order, clock.instant());
        }
        robots.orders().forEach(order -> obey(order, clock.instant()));
        Instant now = clock.instant();
        for (Optional<Timetable.Due> due = draining ? Optional.empty() : timetable.take(now);
                due.isPresent() && !closed && !draining;
                due = timetable.take(now)) {
            scene.report(due.get().device(), due.get().time()).ifPresent(this::send);
        }
        connections.push();
        tally = new Tally(connections.acknowledged(), connections.unacknowledged(), connections.dropped());
        steps = steps + 1;
        if (Duration.between(asked, now).compareTo(ASK) >= 0) {
            asked = now;
            robots.ask(List.copyOf(robotsByEntity.keySet()));
        }
    }

    private void send(Report report) {
        reports.increment();
        if (report instanceof Report.Update update) {
            robots.update(update.entity());
        } else if (report instanceof Report.Measures measures) {
            connections.send(measures.device(), "attrs", measures.json());
        }
    }

    private void obey(Heard order, Instant now) {
        SimulatedDevice device = devices.get(order.device());
        try {
            JsonNode json = NgsiJson.read(order.payload());
            ObjectNode results = NODES.objectNode();
            for (var names = json.fieldNames(); names.hasNext(); ) {
                String command = names.next();
                boolean known = Registrations.COMMANDS.contains(command);
                results.put(command, known ? "ok" : "unknown command");
                if (known) {
                    scene.switchTo(device, command.equals("on"), now).ifPresent(this::send);
                }
            }
            connections.send(order.device(), "cmdexe", results);
        } catch (UnreadableException e) {
            LOG.warn("{} got a command that is no JSON: {}", order.device(), e.getMessage());
        }
    }

    private void obey(RobotLink.Order order, Instant now) {
        Robot robot = robotsByEntity.get(order.entity());
        Optional<Command> command = Command.of(order.word());
        if (robot == null) {
            return;
        }
        command.ifPresent(known -> scene.tell(robot, known, now));
        // Without the word itself: the context broker refuses some signs in texts.
        robots.answer(
                order.entity(),
                command.isPresent(),
                command.map(Command::toString).orElse("no such command: use Running, Stop or Resume"));
    }
}
