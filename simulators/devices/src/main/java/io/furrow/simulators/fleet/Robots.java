package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.Map;

import io.furrow.model.event.FiwareScope;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;

/** The robots of a fleet: reports each to its context broker tenant, and executes the commands received there. */
final class Robots {
    private static final Duration POLL_INTERVAL = Duration.ofMillis(500);
    private static final String RESTART = "restart";

    private final FleetSettings settings;
    private final FarmSimulation simulation;
    private final FleetEvents events;
    private final Map<FiwareScope, RobotClient> clients = new HashMap<>();
    private final Map<String, Robot> robots = new HashMap<>();
    private final Map<String, RobotClient> clientOf = new HashMap<>();
    private final Map<String, Instant> restarting = new HashMap<>();
    private Instant polled = Instant.MIN;

    Robots(FleetSettings settings, FarmSimulation simulation, FleetEvents events) {
        this.settings = settings;
        this.simulation = simulation;
        this.events = events;
    }

    static FiwareScope scope(FleetSettings settings) {
        return FiwareScope.of(settings.fiwareService(), settings.servicePath());
    }

    void add(Robot robot, FiwareScope scope) {
        RobotClient client = clients.computeIfAbsent(scope, this::client);
        client.add(robot.id(), robot.identity().entity());
        robots.put(robot.id(), robot);
        clientOf.put(robot.id(), client);
    }

    private RobotClient client(FiwareScope scope) {
        return new RobotClient(
                new FleetSettings(
                                settings.contextBroker(), null, null, null, null, scope.service(), scope.servicePath())
                        .withToken(settings.token()),
                events);
    }

    void remove(String device) {
        Robot robot = robots.remove(device);
        if (robot != null) {
            clientOf.remove(device).remove(robot.identity().entity());
        }
    }

    void send(Report.Update update) {
        RobotClient client = clientOf.get(update.device());
        if (client != null) {
            client.update(update.entity());
        }
    }

    /** Executes the commands received since the last call. */
    void obey(Instant now) {
        clients.values().forEach(client -> client.orders().forEach(order -> obey(client, order, now)));
    }

    private void obey(RobotClient client, RobotClient.Order order, Instant now) {
        Robot robot = robots.get(order.device());
        switch (order.command()) {
            case "Running", "Resume", "Stop" -> {
                simulation.command(robot, order.command().equals("Stop"), now);
                client.answer(order.entity(), true, order.command());
            }
            case "on", "off" -> {
                simulation.switchTo(robot, order.command().equals("on"), now);
                client.answer(order.entity(), true, order.command());
            }
            case RESTART -> {
                Instant until = now.plus(DeviceCommandExecutor.RESTART);
                simulation.restart(robot.id(), until);
                restarting.put(robot.id(), until);
                client.restart(order.entity());
            }
            // Without the word itself: the context broker refuses some characters in texts.
            default ->
                client.answer(order.entity(), false, "no such command: use Running, Stop, Resume, on, off or restart");
        }
    }

    /** Answers the restart commands that are over. */
    private void endRestarts(Instant now) {
        restarting.entrySet().removeIf(each -> {
            boolean back = !now.isBefore(each.getValue());
            Robot robot = robots.get(each.getKey());
            if (back && robot != null) {
                clientOf.get(robot.id()).answer(robot.identity().entity(), true, RESTART);
            }
            return back;
        });
    }

    /** Polls for commands twice a second, and publishes results of robots that do not report. */
    void poll(Instant now) {
        if (Duration.between(polled, now).compareTo(POLL_INTERVAL) >= 0) {
            polled = now;
            endRestarts(now);
            clients.values().forEach(RobotClient::publishResults);
            clients.values().forEach(RobotClient::poll);
        }
    }
}
