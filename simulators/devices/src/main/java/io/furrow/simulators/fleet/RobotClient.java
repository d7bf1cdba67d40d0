package io.furrow.simulators.fleet;

import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicReference;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.device.FiwareHttp;
import io.furrow.simulators.device.FleetSettings;

/**
 * Connects robots with the context broker. At most one update of a robot is in flight, which keeps them in order; one
 * that comes meanwhile is dropped, as FIROS does. Commands are polled: the first update of a robot empties its {@code
 * cmd}, so that no old command runs again; after that each change of {@code cmd} is a command. A change that is
 * reverted between two polls is missed.
 */
final class RobotClient {
    private static final Logger LOG = LoggerFactory.getLogger(RobotClient.class);
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final int PAGE = 500;
    private static final String TYPE = "ROBOT";

    private final FleetSettings settings;
    private final FiwareHttp http;
    private final FleetEvents events;
    private final Map<String, ConnectedRobot> robots = new ConcurrentHashMap<>();
    private final Queue<Order> orders = new ConcurrentLinkedQueue<>();
    private final AtomicBoolean polling = new AtomicBoolean();
    private volatile boolean unavailable;

    /** The content of {@code cmd} of a robot's entity. */
    record Order(String device, String entity, String command) {}

    private static final class ConnectedRobot {
        private final String device;
        private final AtomicBoolean busy = new AtomicBoolean();
        private final AtomicReference<ObjectNode> result = new AtomicReference<>(NODES.objectNode());
        /** Whether its {@code cmd} has been emptied. */
        private volatile boolean listening;

        private volatile int attempts;
        private String last;

        ConnectedRobot(String device) {
            this.device = device;
        }
    }

    RobotClient(FleetSettings settings, FleetEvents events) {
        this.settings = settings;
        this.http = new FiwareHttp(settings);
        this.events = events;
    }

    /** Adds a robot, whose {@code cmd} is yet to be emptied. */
    void add(String device, String entity) {
        robots.put(entity, new ConnectedRobot(device));
    }

    void remove(String entity) {
        robots.remove(entity);
    }

    /** Writes an entity asynchronously. */
    void update(Entity entity) {
        ConnectedRobot robot = robots.get(entity.id());
        if (robot == null || !robot.busy.compareAndSet(false, true)) {
            return;
        }
        ObjectNode result = robot.result.get();
        boolean listening = robot.listening;
        ObjectNode more = listening ? result : attribute("cmd", "String", "").setAll(result);
        ObjectNode body = NODES.objectNode().put("actionType", "append");
        body.putArray("entities").add(entity.json().deepCopy().<ObjectNode>setAll(more));
        http.postAsync(settings.contextBroker(), "/v2/op/update", body).whenComplete((answer, failure) -> {
            boolean arrived = failure == null && answer.statusCode() / 100 == 2;
            String reason = arrived ? "" : reason(answer, failure);
            if (arrived) {
                robot.result.compareAndSet(result, NODES.objectNode());
                if (!listening) {
                    robot.listening = true;
                    events.up(robot.device);
                }
            } else if (!listening) {
                robot.attempts++;
                events.failed(robot.device, robot.attempts, reason);
            }
            robot.busy.set(false);
            note(arrived, reason);
        });
    }

    /** Stores the result of a command for the robot's next update, as {@code cmd_status} and {@code cmd_info}. */
    void answer(String entity, boolean obeyed, String sentence) {
        ObjectNode result = attribute("cmd_status", "commandStatus", obeyed ? "OK" : "ERROR");
        robots.get(entity).result.set(result.setAll(attribute("cmd_info", "commandResult", sentence)));
    }

    /** Publishes results of commands for robots that do not report at the moment. */
    void publishResults() {
        robots.forEach((entity, robot) -> {
            if (!robot.result.get().isEmpty()) {
                update(Entity.builder(entity, TYPE).build());
            }
        });
    }

    /** Treats a robot as new: its {@code cmd} is emptied before it gets a command again. */
    void restart(String entity) {
        ConnectedRobot robot = robots.get(entity);
        robot.listening = false;
        robot.last = null;
    }

    private static ObjectNode attribute(String name, String type, String value) {
        ObjectNode json = NODES.objectNode();
        json.putObject(name).put("type", type).put("value", value);
        return json;
    }

    /** Polls for commands asynchronously; at most one poll is in flight. */
    void poll() {
        List<String> entities = new ArrayList<>();
        robots.forEach((entity, robot) -> {
            if (robot.listening) {
                entities.add(entity);
            }
        });
        if (entities.isEmpty() || !polling.compareAndSet(false, true)) {
            return;
        }
        poll(entities, 0);
    }

    private void poll(List<String> entities, int from) {
        ObjectNode query = NODES.objectNode();
        ArrayNode desired = query.putArray("entities");
        List<String> page = entities.subList(from, Math.min(entities.size(), from + PAGE));
        page.forEach(id -> desired.addObject().put("id", id).put("type", TYPE));
        query.putArray("attrs").add("cmd");
        http.postAsync(settings.contextBroker(), "/v2/op/query?limit=" + PAGE, query)
                .whenComplete((answer, failure) -> {
                    if (failure == null && answer.statusCode() == 200) {
                        read(answer.body());
                    }
                    if (failure == null && from + PAGE < entities.size()) {
                        poll(entities, from + PAGE);
                    } else {
                        polling.set(false);
                    }
                });
    }

    private void read(String body) {
        try {
            for (JsonNode entity : NgsiJson.read(body.getBytes(StandardCharsets.UTF_8))) {
                String command = entity.path("cmd").path("value").asText("");
                ConnectedRobot robot = robots.get(entity.path("id").asText());
                if (!command.isBlank() && robot != null && robot.listening) {
                    orders.add(new Order(robot.device, entity.path("id").asText(), command));
                }
            }
        } catch (UnreadableException e) {
            LOG.warn("{} answers a poll for commands with invalid JSON", settings.contextBroker(), e);
        }
    }

    /** The new commands since the last call; from one thread. */
    List<Order> orders() {
        List<Order> fresh = new ArrayList<>();
        for (Order order = orders.poll(); order != null; order = orders.poll()) {
            ConnectedRobot robot = robots.get(order.entity());
            if (robot != null && !order.command().equals(robot.last)) {
                robot.last = order.command();
                fresh.add(order);
            }
        }
        return fresh;
    }

    private String reason(HttpResponse<String> answer, Throwable failure) {
        return failure == null
                ? "the context broker %s answers %d: %s"
                        .formatted(settings.contextBroker(), answer.statusCode(), answer.body())
                : "no answer from the context broker %s: is it running?".formatted(settings.contextBroker());
    }

    /** Logs once that updates fail, and once that they succeed again. */
    private void note(boolean arrived, String reason) {
        if (!arrived && !unavailable) {
            LOG.warn("{} does not accept updates of robots: {}", settings.contextBroker(), reason);
        } else if (arrived && unavailable) {
            LOG.info("{} accepts updates of robots again", settings.contextBroker());
        }
        unavailable = !arrived;
    }
}
