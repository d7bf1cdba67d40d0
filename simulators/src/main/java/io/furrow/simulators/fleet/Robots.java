package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import io.furrow.model.event.FiwareScope;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.robot.Command;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;

/** The robots of a fleet: to which context broker's tenant each reports, and what they are told there. */
final class Robots {
    private static final Duration ASK = Duration.ofMillis(500);
    private static final Set<String> SWITCHES = Set.of("on", "off");
    private static final String RESTART = "restart";

    private final FleetSettings settings;
    private final Scene scene;
    private final FleetEvents events;
    private final Map<FiwareScope, RobotLink> links = new HashMap<>();
    private final Map<String, Robot> robots = new HashMap<>();
    private final Map<String, RobotLink> linkOf = new HashMap<>();
    private final Map<String, Instant> restarting = new HashMap<>();
    private Instant asked = Instant.MIN;

    Robots(FleetSettings settings, Scene scene, FleetEvents events) {
        this.settings = settings;
        this.scene = scene;
        this.events = events;
    }

    /** That of the settings. */
    static FiwareScope scope(FleetSettings settings) {
        return FiwareScope.of(settings.fiwareService(), settings.servicePath());
    }

    void add(Robot robot, FiwareScope scope) {
        RobotLink link = links.computeIfAbsent(scope, this::link);
        link.add(robot.id(), robot.identity().entity());
        robots.put(robot.id(), robot);
        linkOf.put(robot.id(), link);
    }

    private RobotLink link(FiwareScope scope) {
        return new RobotLink(
                new FleetSettings(
                        settings.contextBroker(), null, null, null, null, scope.service(), scope.servicePath()),
                events);
    }

    void remove(String device) {
        Robot robot = robots.remove(device);
        if (robot != null) {
            linkOf.remove(device).remove(robot.identity().entity());
        }
    }

    void send(Report.Update update) {
        RobotLink link = linkOf.get(update.device());
        if (link != null) {
            link.update(update.entity());
        }
    }

    /** Lets robots do what they were told since the last time. */
    void obey(Instant now) {
        links.values().forEach(link -> link.orders().forEach(order -> obey(link, order, now)));
    }

    private void obey(RobotLink link, RobotLink.Order order, Instant now) {
        Robot robot = robots.get(order.device());
        Optional<Command> command = Command.of(order.word());
        if (command.isPresent()) {
            scene.tell(robot, command.get(), now);
            link.answer(order.entity(), true, order.word());
        } else if (SWITCHES.contains(order.word())) {
            scene.switchTo(robot, order.word().equals("on"), now);
            link.answer(order.entity(), true, order.word());
        } else if (order.word().equals(RESTART)) {
            Instant until = now.plus(Commands.RESTART);
            scene.restart(robot.id(), until);
            restarting.put(robot.id(), until);
            link.beginAnew(order.entity());
        } else {
            // Without the word itself: the context broker refuses some signs in texts.
            link.answer(order.entity(), false, "no such command: use Running, Stop, Resume, on, off or restart");
        }
    }

    /** Says that robots are there again which were told to restart. */
    private void comeBack(Instant now) {
        restarting.entrySet().removeIf(each -> {
            boolean back = !now.isBefore(each.getValue());
            Robot robot = robots.get(each.getKey());
            if (back && robot != null) {
                linkOf.get(robot.id()).answer(robot.identity().entity(), true, RESTART);
            }
            return back;
        });
    }

    /** Asks for commands, twice a second, and says what became of them where no report does. */
    void ask(Instant now) {
        if (Duration.between(asked, now).compareTo(ASK) >= 0) {
            asked = now;
            comeBack(now);
            links.values().forEach(RobotLink::sayResults);
            links.values().forEach(RobotLink::ask);
        }
    }
}
