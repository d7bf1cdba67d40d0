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

import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.mqtt.MqttConnection;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;

/**
 * The MQTT connections of a farm: each device has its own up to a number of devices; beyond it each mission has one, a
 * gateway. The topics are those of the device either way. Used by one thread, except {@link #count}.
 */
final class Connections implements AutoCloseable {
    static final int MAX_OWN = 500;

    private static final int OWN_MAX_MESSAGES = 20_000;
    private static final long OWN_BYTES = 2L << 20;
    private static final int GATEWAY_MAX_MESSAGES = 400_000;
    private static final long GATEWAY_BYTES = 128L << 20;

    private final FleetAccess access;
    private final UnaryOperator<String> apiKeys;
    private final int maxOwn;
    private final Map<String, Channel> channels = new HashMap<>();
    private final Map<String, String> topics = new HashMap<>();
    private final Map<String, Channel> gateways = new HashMap<>();
    private final Set<Channel> all = ConcurrentHashMap.newKeySet();
    private final Queue<Command> commands = new ConcurrentLinkedQueue<>();

    /** A message received for a device. */
    record Command(Channel channel, String device, byte[] payload) {}

    /**
     * @param apiKeys of missions, first part of their topics
     *
     * @param maxOwn maximum number of devices with their own connections
     */
    Connections(FleetAccess access, UnaryOperator<String> apiKeys, int maxOwn) {
        this.access = access;
        this.apiKeys = apiKeys;
        this.maxOwn = maxOwn;
    }

    /** A connection, opened or not yet, and its devices. */
    final class Channel {
        private final Supplier<MqttConnection.Plan> plans;
        private final String mission;
        private final boolean gateway;
        private final Set<String> devices = new LinkedHashSet<>();
        private MqttConnection.Plan plan;
        private MqttConnection connection;
        private MqttConnection next;
        private boolean ended;

        private Channel(Supplier<MqttConnection.Plan> plans, String mission, boolean gateway) {
            this.plans = plans;
            this.plan = plans.get();
            this.mission = mission;
            this.gateway = gateway;
        }

        /**
         * Opens it, on any thread; if it is open already, opens a second connection that replaces the first at the next
         * {@link Connections#change}.
         *
         * @throws IOException if the broker is unavailable or refuses
         */
        void open() throws IOException {
            MqttConnection opened = MqttConnection.open(access.mqtt(), plan(), this::received);
            MqttConnection needless = retain(opened);
            if (needless != null) {
                needless.close();
            }
        }

        private synchronized MqttConnection.Plan plan() {
            return plan;
        }

        /** Renews login and topics; returns whether it is open with others. */
        private synchronized boolean isOutdated() {
            MqttConnection.Plan fresh = plans.get();
            boolean same = fresh.equals(plan);
            plan = fresh;
            return !same && connection != null;
        }

        private void received(String topic, byte[] payload) {
            String[] parts = topic.split("/");
            commands.add(new Command(this, parts[parts.length - 2], payload));
        }

        /** Returns the connection that is not needed; null if there is none. */
        private synchronized MqttConnection retain(MqttConnection opened) {
            if (ended) {
                return opened;
            }
            if (connection == null) {
                connection = opened;
                return null;
            }
            MqttConnection before = next;
            next = opened;
            return before;
        }

        /** Replaces the first connection by the second, if one is open; returns the first, to be closed. */
        private synchronized Optional<MqttConnection> change() {
            if (next == null) {
                return Optional.empty();
            }
            MqttConnection before = connection;
            next.takeOver(before);
            connection = next;
            next = null;
            return Optional.of(before);
        }

        synchronized boolean isEnded() {
            return ended;
        }

        synchronized boolean isOpen() {
            return connection != null;
        }

        synchronized Optional<MqttConnection> connection() {
            return Optional.ofNullable(connection);
        }

        /** Ends it; returns its connections, to be closed. */
        private synchronized List<MqttConnection> end() {
            ended = true;
            List<MqttConnection> last =
                    Stream.of(connection, next).filter(Objects::nonNull).toList();
            connection = null;
            next = null;
            return last;
        }

        List<String> devices() {
            return List.copyOf(devices);
        }
    }

    /**
     * Adds devices, all with their own connections or all with gateways.
     *
     * @return the channels to open
     */
    Collection<Channel> add(Collection<Identity> devices) {
        long own = all.stream().filter(channel -> !channel.gateway).count();
        boolean many = own + devices.size() > maxOwn;
        Set<Channel> fresh = new LinkedHashSet<>();
        for (Identity device : devices) {
            String mission = device.mission();
            Channel channel = gateways.get(mission);
            if (channel == null && many) {
                channel = new Channel(() -> gateway(mission), mission, true);
                gateways.put(mission, channel);
                fresh.add(channel);
            } else if (channel == null) {
                channel = new Channel(() -> own(device), mission, false);
                fresh.add(channel);
            }
            channel.devices.add(device.id());
            channels.put(device.id(), channel);
            topics.put(device.id(), topic(mission, device.id()));
        }
        all.addAll(fresh);
        return fresh;
    }

    private MqttConnection.Plan own(Identity device) {
        MqttAccess.Login login = access.logins().device().apply(device);
        String commands = topic(device.mission(), device.id()) + "cmd";
        return new MqttConnection.Plan(login, device.id(), List.of(commands), OWN_MAX_MESSAGES, OWN_BYTES);
    }

    private MqttConnection.Plan gateway(String mission) {
        MqttAccess.Login login = access.logins().gateway().apply(mission);
        String commands = topic(mission, "+") + "cmd";
        return new MqttConnection.Plan(
                login, "gateway-" + mission, List.of(commands), GATEWAY_MAX_MESSAGES, GATEWAY_BYTES);
    }

    /** Prefix of a device's topics. */
    private String topic(String mission, String device) {
        return "/" + apiKeys.apply(mission) + "/" + device + "/";
    }

    /**
     * Renews logins and API keys.
     *
     * @return the channels open with others, to be opened again; they stay in use until then
     */
    Collection<Channel> renew() {
        List<Channel> outdated = all.stream().filter(Channel::isOutdated).toList();
        all.stream().filter(channel -> !channel.isOpen()).forEach(this::retopic);
        return outdated;
    }

    private void retopic(Channel channel) {
        channel.devices.forEach(device -> topics.put(device, topic(channel.mission, device)));
    }

    /** Switches to the connections opened again; returns the replaced ones, to be closed. */
    Collection<MqttConnection> change() {
        List<MqttConnection> replaced = new ArrayList<>();
        for (Channel channel : all) {
            channel.change().ifPresent(connection -> {
                retopic(channel);
                replaced.add(connection);
            });
        }
        return replaced;
    }

    /** The channel of a device, open or not. */
    Optional<Channel> of(String device) {
        return Optional.ofNullable(channels.get(device));
    }

    /** Removes a device; returns the connections without devices, to be closed. */
    List<MqttConnection> remove(String device) {
        Channel channel = channels.remove(device);
        topics.remove(device);
        if (channel == null || !channel.devices.remove(device) || !channel.devices.isEmpty()) {
            return List.of();
        }
        all.remove(channel);
        gateways.remove(channel.mission, channel);
        return channel.end();
    }

    /** The next command for one of the devices; empty if none waits. */
    Optional<Command> command() {
        for (Command next = commands.poll(); next != null; next = commands.poll()) {
            if (channels.get(next.device()) == next.channel()) {
                return Optional.of(next);
            }
        }
        return Optional.empty();
    }

    /**
     * Publishes JSON for a device that is connected.
     *
     * @param end {@code attrs} or {@code cmdexe}
     */
    void send(String device, String end, ObjectNode json) {
        byte[] payload = json.toString().getBytes(StandardCharsets.UTF_8);
        of(device)
                .flatMap(Channel::connection)
                .ifPresent(connection -> connection.send(topics.get(device) + end, payload));
    }

    /** Sends waiting messages and reconnects. */
    void push() {
        connections().forEach(MqttConnection::push);
    }

    int count() {
        return (int) all.stream().filter(Channel::isOpen).count();
    }

    FarmFleet.Tally tally() {
        return new FarmFleet.Tally(
                sum(MqttConnection::acknowledged), sum(MqttConnection::open), sum(MqttConnection::dropped));
    }

    private long sum(ToLongFunction<MqttConnection> count) {
        return connections().stream().mapToLong(count).sum();
    }

    private List<MqttConnection> connections() {
        List<MqttConnection> connections = new ArrayList<>();
        all.forEach(channel -> channel.connection().ifPresent(connections::add));
        return connections;
    }

    @Override
    public void close() {
        Set<MqttConnection> connections = new HashSet<>();
        all.forEach(channel -> connections.addAll(channel.end()));
        connections.parallelStream().forEach(MqttConnection::close);
    }
}
