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
    private final FarmSimulation scene;
    private final FleetEvents events;
    private final Map<FiwareScope, RobotClient> links = new HashMap<>();
    private final Map<String, Robot> robots = new HashMap<>();
    private final Map<String, RobotClient> linkOf = new HashMap<>();
    private final Map<String, Instant> restarting = new HashMap<>();
    private Instant polled = Instant.MIN;

    Robots(FleetSettings settings, FarmSimulation scene, FleetEvents events) {
        this.settings = settings;
        this.scene = scene;
        this.events = events;
    }

    static FiwareScope scope(FleetSettings settings) {
        return FiwareScope.of(settings.fiwareService(), settings.servicePath());
    }

    void add(Robot robot, FiwareScope scope) {
        RobotClient link = links.computeIfAbsent(scope, this::link);
        link.add(robot.id(), robot.identity().entity());
        robots.put(robot.id(), robot);
        linkOf.put(robot.id(), link);
    }

    private RobotClient link(FiwareScope scope) {
        return new RobotClient(
                new FleetSettings(
                                settings.contextBroker(), null, null, null, null, scope.service(), scope.servicePath())
                        .withToken(settings.token()),
                events);
    }

    void remove(String device) {
        Robot robot = robots.remove(device);
        if (robot != null) {
            linkOf.remove(device).remove(robot.identity().entity());
        }
    }

    void send(Report.Update update) {
        RobotClient link = linkOf.get(update.device());
        if (link != null) {
            link.update(update.entity());
        }
    }

    /** Executes the commands received since the last call. */
    void obey(Instant now) {
        links.values().forEach(link -> link.orders().forEach(order -> obey(link, order, now)));
    }

    private void obey(RobotClient link, RobotClient.Order order, Instant now) {
        Robot robot = robots.get(order.device());
        switch (order.word()) {
            case "Running", "Resume", "Stop" -> {
                scene.command(robot, order.word().equals("Stop"), now);
                link.answer(order.entity(), true, order.word());
            }
            case "on", "off" -> {
                scene.switchTo(robot, order.word().equals("on"), now);
                link.answer(order.entity(), true, order.word());
            }
            case RESTART -> {
                Instant until = now.plus(DeviceCommandExecutor.RESTART);
                scene.restart(robot.id(), until);
                restarting.put(robot.id(), until);
                link.restart(order.entity());
            }
            // Without the word itself: the context broker refuses some characters in texts.
            default ->
                link.answer(order.entity(), false, "no such command: use Running, Stop, Resume, on, off or restart");
        }
    }

    /** Answers the restart commands that are over. */
    private void endRestarts(Instant now) {
        restarting.entrySet().removeIf(each -> {
            boolean back = !now.isBefore(each.getValue());
            Robot robot = robots.get(each.getKey());
            if (back && robot != null) {
                linkOf.get(robot.id()).answer(robot.identity().entity(), true, RESTART);
            }
            return back;
        });
    }

    /** Polls for commands twice a second, and publishes results of robots that do not report. */
    void poll(Instant now) {
        if (Duration.between(polled, now).compareTo(POLL_INTERVAL) >= 0) {
            polled = now;
            endRestarts(now);
            links.values().forEach(RobotClient::publishResults);
            links.values().forEach(RobotClient::poll);
        }
    }
}
