package io.furrow.simulators.fleet;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Queue;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.function.Supplier;
import java.util.function.ToLongFunction;
import java.util.function.UnaryOperator;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.simulators.mqtt.Line;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;

/**
 * The MQTT connections of a farm: devices have one each while that makes no more than so many; of those beyond each mission has
 * one, a gateway. The topics are those of the device either way. One thread uses them, but {@link #count}.
 */
final class Connections implements AutoCloseable {
    static final int MOST_OWN = 500;

    private static final int OWN_KEPT = 20_000;
    private static final long OWN_BYTES = 2L << 20;
    private static final int GATEWAY_KEPT = 400_000;
    private static final long GATEWAY_BYTES = 128L << 20;

    private final FleetAccess access;
    private final UnaryOperator<String> apiKeys;
    private final int mostOwn;
    private final Map<String, Way> ways = new HashMap<>();
    private final Map<String, String> topics = new HashMap<>();
    private final Map<String, Way> gateways = new HashMap<>();
    private final Set<Way> all = ConcurrentHashMap.newKeySet();
    private final Queue<Command> commands = new ConcurrentLinkedQueue<>();

    /** What came over MQTT for a device. */
    record Command(Way way, String device, byte[] payload) {}

    /**
     * @param apiKeys of missions, first part of their topics
     * @param mostOwn how many devices have a connection of their own
     */
    Connections(FleetAccess access, UnaryOperator<String> apiKeys, int mostOwn) {
        this.access = access;
        this.apiKeys = apiKeys;
        this.mostOwn = mostOwn;
    }

    /** A connection, or what is to become one, and whose it is. */
    final class Way {
        private final Supplier<Line.Plan> plans;
        private final String mission;
        private final boolean gateway;
        private final Set<String> devices = new LinkedHashSet<>();
        private Line.Plan plan;
        private Line line;
        private Line next;
        private boolean ended;

        private Way(Supplier<Line.Plan> plans, String mission, boolean gateway) {
            this.plans = plans;
            this.plan = plans.get();
            this.mission = mission;
            this.gateway = gateway;
        }

        /**
         * Opens it, on any thread; where it is open already a second line, which takes the place of the first when {@link
         * Connections#change} comes to it.
         *
         * @throws IOException if the broker is away or refuses
         */
        void open() throws IOException {
            Line opened = Line.open(access.mqtt(), plan(), this::heard);
            Line needless = keep(opened);
            if (needless != null) {
                needless.close();
            }
        }

        private synchronized Line.Plan plan() {
            return plan;
        }

        /** Takes up the login and the topics of now. @return whether it is open with others */
        private synchronized boolean isOutdated() {
            Line.Plan fresh = plans.get();
            boolean same = fresh.equals(plan);
            plan = fresh;
            return !same && line != null;
        }

        private void heard(String topic, byte[] payload) {
            String[] parts = topic.split("/");
            commands.add(new Command(this, parts[parts.length - 2], payload));
        }

        /** Answers the line that is not needed, if one is not. */
        private synchronized Line keep(Line opened) {
            if (ended) {
                return opened;
            }
            if (line == null) {
                line = opened;
                return null;
            }
            Line before = next;
            next = opened;
            return before;
        }

        /** Lets the second line take the place of the first, if there is one; answers the first, which is to be closed. */
        private synchronized Optional<Line> change() {
            if (next == null) {
                return Optional.empty();
            }
            Line before = line;
            next.takeOver(before);
            line = next;
            next = null;
            return Optional.of(before);
        }

        /** Whether nobody needs it any more. */
        synchronized boolean isEnded() {
            return ended;
        }

        synchronized boolean isOpen() {
            return line != null;
        }

        synchronized Optional<Line> line() {
            return Optional.ofNullable(line);
        }

        /** No line of it is kept from now on; answers those that were. */
        private synchronized List<Line> end() {
            ended = true;
            List<Line> last = Stream.of(line, next).filter(Objects::nonNull).toList();
            line = null;
            next = null;
            return last;
        }

        /** The devices that speak over it. */
        List<String> devices() {
            return List.copyOf(devices);
        }
    }

    /**
     * Takes devices in, all with connections of their own or all with gateways.
     *
     * @return what is to be opened for them
     */
    Collection<Way> add(Collection<Identity> devices) {
        long own = all.stream().filter(way -> !way.gateway).count();
        boolean many = own + devices.size() > mostOwn;
        Set<Way> fresh = new LinkedHashSet<>();
        for (Identity device : devices) {
            String mission = device.mission();
            Way way = gateways.get(mission);
            if (way == null && many) {
                way = new Way(() -> gateway(mission), mission, true);
                gateways.put(mission, way);
                fresh.add(way);
            } else if (way == null) {
                way = new Way(() -> own(device), mission, false);
                fresh.add(way);
            }
            way.devices.add(device.id());
            ways.put(device.id(), way);
            topics.put(device.id(), topic(mission, device.id()));
        }
        all.addAll(fresh);
        return fresh;
    }

    private Line.Plan own(Identity device) {
        MqttAccess.Login login = access.logins().device(device);
        String commands = topic(device.mission(), device.id()) + "cmd";
        return new Line.Plan(login, device.id(), List.of(commands), OWN_KEPT, OWN_BYTES);
    }

    private Line.Plan gateway(String mission) {
        MqttAccess.Login login = access.logins().gateway(mission);
        String commands = topic(mission, "+") + "cmd";
        return new Line.Plan(login, "gateway-" + mission, List.of(commands), GATEWAY_KEPT, GATEWAY_BYTES);
    }

    /** The start of a device's topics. */
    private String topic(String mission, String device) {
        return "/" + apiKeys.apply(mission) + "/" + device + "/";
    }

    /**
     * Takes up logins and API keys as they are now.
     *
     * @return what is open with others, and is to be opened again: it stays in use until then
     */
    Collection<Way> renew() {
        List<Way> outdated = all.stream().filter(Way::isOutdated).toList();
        all.stream().filter(way -> !way.isOpen()).forEach(this::retopic);
        return outdated;
    }

    private void retopic(Way way) {
        way.devices.forEach(device -> topics.put(device, topic(way.mission, device)));
    }

    /** Uses what was opened again; answers the lines whose place it takes, which are to be closed. */
    Collection<Line> change() {
        List<Line> replaced = new ArrayList<>();
        for (Way way : all) {
            way.change().ifPresent(line -> {
                retopic(way);
                replaced.add(line);
            });
        }
        return replaced;
    }

    /** The connection of a device, open or not. */
    Optional<Way> of(String device) {
        return Optional.ofNullable(ways.get(device));
    }

    /** Lets a device go; answers the lines that nobody uses any more, which are to be closed. */
    List<Line> remove(String device) {
        Way way = ways.remove(device);
        topics.remove(device);
        if (way == null || !way.devices.remove(device) || !way.devices.isEmpty()) {
            return List.of();
        }
        all.remove(way);
        gateways.remove(way.mission, way);
        return way.end();
    }

    /** The next command for one of the devices; empty where there is none now. */
    Optional<Command> command() {
        for (Command next = commands.poll(); next != null; next = commands.poll()) {
            if (ways.get(next.device()) == next.way()) {
                return Optional.of(next);
            }
        }
        return Optional.empty();
    }

    /** Says something for a device that has a connection. @param end {@code attrs} or {@code cmdexe} */
    void send(String device, String end, ObjectNode json) {
        byte[] payload = json.toString().getBytes(StandardCharsets.UTF_8);
        of(device).flatMap(Way::line).ifPresent(line -> line.send(topics.get(device) + end, payload));
    }

    /** Sends what waits and opens again what is broken. */
    void push() {
        lines().forEach(Line::push);
    }

    int count() {
        return (int) all.stream().filter(Way::isOpen).count();
    }

    FarmFleet.Tally tally() {
        return new FarmFleet.Tally(sum(Line::acknowledged), sum(Line::open), sum(Line::dropped));
    }

    private long sum(ToLongFunction<Line> count) {
        return lines().stream().mapToLong(count).sum();
    }

    private List<Line> lines() {
        List<Line> lines = new ArrayList<>();
        all.forEach(way -> way.line().ifPresent(lines::add));
        return lines;
    }

    @Override
    public void close() {
        Set<Line> lines = new HashSet<>();
        all.forEach(way -> lines.addAll(way.end()));
        lines.parallelStream().forEach(Line::close);
    }
}
