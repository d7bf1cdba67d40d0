package io.furrow.soak.control;

import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.CommandResult;
import io.furrow.model.topic.Topics;

/**
 * Sends requests for one mission, one after the other, and tracks its desired state by the answers. No other actor
 * sends requests for this mission, so an answer that its state does not explain is a fault.
 */
final class MissionActor {
    private static final String TYPE = "Thermometer";
    private static final int MAX_DEVICES = 6;

    private final String mission;
    private final String domain;
    private final Requester requester;
    private final Random random;
    private final List<String> faults;
    private final Map<String, Integer> generations = new ConcurrentHashMap<>();
    private int number;
    private int failed;
    private volatile int devices;
    private volatile boolean exists;
    private volatile boolean running;

    /** @param faults receives unexpected answers */
    MissionActor(String mission, String domain, Requester requester, Random random, List<String> faults) {
        this.mission = mission;
        this.domain = domain;
        this.requester = requester;
        this.random = random;
        this.faults = faults;
    }

    String mission() {
        return mission;
    }

    boolean exists() {
        return exists;
    }

    boolean isRunning() {
        return running;
    }

    /** How often the mission failed because its devices did not come up in time. */
    int failed() {
        return failed;
    }

    /** Entity ids of its devices. */
    Set<String> devices() {
        Set<String> ids = new TreeSet<>();
        IntStream.rangeClosed(1, devices).forEach(i -> ids.add("urn:ngsi-ld:%s:%s-%d".formatted(TYPE, mission, i)));
        return ids;
    }

    /** The number of rotations of each device whose credentials were rotated. */
    Map<String, Integer> generations() {
        return generations;
    }

    /** Sends a request that the mission's state allows, sometimes one that it does not. */
    void step() throws InterruptedException {
        int choice = random.nextInt(10);
        if (!exists) {
            if (choice < 5) {
                create();
            } else {
                start(true);
            }
        } else if (running) {
            if (choice < 5) {
                stop();
            } else if (choice < 8) {
                rotate();
            } else {
                delete();
            }
        } else if (choice < 6) {
            start(random.nextInt(3) == 0);
        } else if (choice < 8 && devices < MAX_DEVICES) {
            addDevices();
        } else {
            delete();
        }
    }

    private void create() throws InterruptedException {
        int count = 1 + random.nextInt(3);
        if (isAccepted(request("create", members(true).set("devices", list(count))), Set.of())) {
            exists = true;
            devices = count;
        }
    }

    /** Starts the mission; a rejection is a fault unless the mission is still stopping. */
    void start(boolean withList) throws InterruptedException {
        int count = 1 + random.nextInt(3);
        ObjectNode members = members(true);
        if (withList) {
            members.set("devices", list(count));
        }
        if (isAccepted(request("start", members), Set.of("mission-running"))) {
            devices = withList ? count : devices;
            exists = true;
            running = true;
        }
    }

    private void stop() throws InterruptedException {
        CommandResult answer = request("stop", members(false));
        if (isAccepted(answer, Set.of("mission-not-running"))) {
            running = false;
        } else if (answer.json().path("reason").asText().contains("failed")) {
            running = false;
            failed++;
        }
    }

    private void delete() throws InterruptedException {
        if (isAccepted(request("delete", members(false)), Set.of("mission-running"))) {
            exists = false;
            running = false;
            devices = 0;
        }
    }

    private void addDevices() throws InterruptedException {
        if (isAccepted(request("add-devices", members(false).set("devices", list(1))), Set.of("mission-running"))) {
            devices++;
        }
    }

    private void rotate() throws InterruptedException {
        String device = devices().iterator().next();
        ObjectNode members = JsonNodeFactory.instance.objectNode().put("device", device);
        CommandResult answer = request("rotate-credentials", members);
        if (isAccepted(answer, Set.of())) {
            generations.put(device, answer.json().path("generation").asInt());
        }
    }

    private boolean isAccepted(CommandResult answer, Set<String> expected) {
        String error = answer.error().orElse("");
        if (!error.isEmpty() && !expected.contains(error)) {
            faults.add("mission %s, which %s, got the answer %s"
                    .formatted(mission, running ? "runs" : exists ? "is there" : "is not there", answer.json()));
        }
        return error.isEmpty();
    }

    private ObjectNode members(boolean withDomain) {
        ObjectNode members = JsonNodeFactory.instance.objectNode().put("mission", mission);
        return withDomain ? members.put("domain", domain) : members;
    }

    private static ArrayNode list(int count) {
        ArrayNode list = JsonNodeFactory.instance.arrayNode();
        ObjectNode group = list.addObject()
                .put("type", TYPE)
                .put("count", count)
                .put("period", "PT2S")
                .put("simulated", true);
        group.putArray("path").addArray().add(-3.48).add(40.31);
        return list;
    }

    private CommandResult request(String command, JsonNode members) throws InterruptedException {
        String id = "%s-%d".formatted(mission, number++);
        ControlRequest request = new ControlRequest(id, Topics.MISSION_MANAGER, command, (ObjectNode) members);
        return requester.request(request, random);
    }
}
