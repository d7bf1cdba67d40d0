package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.control.CommandResult;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.CommittedState;

/** Compares the actual state of the control plane with the state that was requested. */
record ChaosChecks(ChaosFarm farm, List<MissionActor> actors) {
    private static final String[] TENANT = {"fiware-service", "farm", "fiware-servicepath", "/"};

    /** Finds parts of the control planes that are not up. */
    List<String> parts() {
        List<String> faults = new ArrayList<>();
        for (ControlProcess control : farm.controls) {
            JsonNode page = control.readiness();
            if (!page.path("status").asText().equals("ready")) {
                faults.add("%s is %s: %s".formatted(control.name(), page.path("status"), page.path("parts")));
            }
            page.path("parts").properties().forEach(part -> {
                if (!part.getValue().path("state").asText().equals("up")) {
                    faults.add("%s of %s is %s".formatted(part.getKey(), control.name(), part.getValue()));
                }
            });
        }
        return faults;
    }

    /** Compares the missions of both APIs. */
    List<String> missions() {
        List<String> faults = new ArrayList<>();
        for (ControlProcess control : farm.controls) {
            Map<String, JsonNode> shown = new TreeMap<>();
            Http.get(control.api().resolve("/api/missions"))
                    .body()
                    .forEach(mission -> shown.put(mission.path("mission").asText(), mission));
            for (MissionActor each : actors) {
                compare(control.name(), each, shown.remove(each.mission()), faults);
            }
            shown.keySet()
                    .forEach(other -> faults.add(control.name() + " has a mission that was not requested: " + other));
        }
        return faults;
    }

    private static void compare(String api, MissionActor desired, JsonNode shown, List<String> faults) {
        if (!desired.exists() || shown == null) {
            if (desired.exists() || shown != null) {
                faults.add("%s shows of mission %s, which %s: %s"
                        .formatted(api, desired.mission(), desired.exists() ? "is there" : "is not there", shown));
            }
            return;
        }
        JsonNode status = shown.path("status");
        String state = status.path("state").asText();
        int devices = desired.devices().size();
        boolean runs = state.equals("running")
                && status.path("devices").asInt() == devices
                && status.path("confirmed").asInt() == devices;
        boolean rests = Set.of("created", "stopped", "failed").contains(state);
        if (desired.isRunning() ? !runs : !rests) {
            faults.add("%s shows mission %s, expected %s with %d devices, as %s"
                    .formatted(api, desired.mission(), desired.isRunning() ? "running" : "stopped", devices, status));
        }
    }

    /** Compares the devices on the topic, at the IoT Agent and at the MQTT broker. */
    List<String> devices() throws IOException {
        Map<String, String> expected = new TreeMap<>();
        actors.stream()
                .filter(MissionActor::isRunning)
                .forEach(each -> each.devices().forEach(id -> expected.put(id, each.mission())));
        List<String> faults = new ArrayList<>();
        Map<String, DesiredDevice> desired = desired(faults);
        compare("service.devices", expected.keySet(), desired.keySet(), faults);
        compare(
                "the IoT Agent's devices",
                expected.keySet(),
                agent("/iot/devices?limit=1000", "devices", "device_id"),
                faults);
        FarmSecret secret = farm.secret;
        var keys = expected.values().stream().map(secret::apiKey).collect(Collectors.toCollection(TreeSet::new));
        compare("the IoT Agent's groups", keys, agent("/iot/services", "services", "apikey"), faults);
        Set<String> users = new TreeSet<>();
        desired.forEach((id, device) ->
                users.add(secret.device(device.version().mission(), device.device(), device.generation())
                        .user()));
        compare("the MQTT users", users, farm.mosquitto.users(), faults);
        for (MissionActor each : actors) {
            each.generations().forEach((id, generation) -> {
                DesiredDevice device = desired.get(id);
                if (device != null && device.generation() != generation) {
                    faults.add("the credentials of %s were rotated %d times, answered were %d"
                            .formatted(id, device.generation(), generation));
                }
            });
        }
        return faults;
    }

    private Map<String, DesiredDevice> desired(List<String> faults) {
        Map<String, DesiredDevice> running = new HashMap<>();
        CommittedState.table(farm.kafka.bootstrapServers(), Topics.DEVICES).forEach((key, value) -> {
            try {
                DesiredDevice device = DesiredDevice.read(value);
                if (device.running()) {
                    running.put(device.version().id(), device);
                }
            } catch (UnreadableException e) {
                faults.add("service.devices has what cannot be read under " + key + ": " + e.getMessage());
            }
        });
        return running;
    }

    private Set<String> agent(String path, String list, String member) {
        Set<String> found = new TreeSet<>();
        URI uri = farm.directAgent().resolve(path);
        Http.get(uri, TENANT)
                .body()
                .path(list)
                .forEach(each -> found.add(each.path(member).asText()));
        return found;
    }

    private static void compare(String what, Set<String> expected, Set<String> actual, List<String> faults) {
        Set<String> missing = new TreeSet<>(expected);
        missing.removeAll(actual);
        Set<String> unexpected = new TreeSet<>(actual);
        unexpected.removeAll(expected);
        if (!missing.isEmpty() || !unexpected.isEmpty()) {
            faults.add("%s: missing %s, unexpected %s".formatted(what, missing, unexpected));
        }
    }

    /** Finds requests without exactly one answer. */
    List<String> answers(Requester requester, AnswerLog log) {
        List<String> faults = new ArrayList<>();
        requester.sent().forEach((id, text) -> {
            List<CommandResult> answers = log.to(id);
            if (answers.size() != 1) {
                faults.add("request %s, %s, has %d answers: %s".formatted(id, text, answers.size(), answers));
            }
        });
        return faults;
    }

    /** Finds alarms that were not raised, not closed, not delivered in their last state, or not listed. */
    List<String> alarms(Map<String, Boolean> pairs) throws UnreadableException {
        List<String> faults = new ArrayList<>();
        Map<String, List<JsonNode>> bySubject = new HashMap<>();
        Map<String, JsonNode> listed = new HashMap<>();
        URI all = farm.controls.get(0).api().resolve("/api/alarms?limit=10000");
        Http.get(all).body().forEach(alarm -> listed.put(alarm.path("alarm").asText(), alarm));
        for (byte[] value : CommittedState.table(farm.kafka.bootstrapServers(), Topics.ALARMS)
                .values()) {
            JsonNode alarm = NgsiJson.read(value);
            bySubject
                    .computeIfAbsent(alarm.path("subject").asText(), any -> new ArrayList<>())
                    .add(alarm);
            JsonNode shown = listed.get(alarm.path("alarm").asText());
            if (shown == null
                    || shown.path("sequence").asLong() != alarm.path("sequence").asLong()) {
                faults.add("alarm %s is listed as %s".formatted(alarm, shown));
            }
            if (isUndelivered(alarm)) {
                faults.add("the webhook did not take alarm %s in its last state".formatted(alarm));
            }
        }
        pairs.forEach((pair, ended) -> {
            List<JsonNode> raised = bySubject.getOrDefault(pair, List.of());
            boolean closed = raised.stream()
                    .allMatch(alarm -> alarm.path("state").asText().equals("closed"));
            if (raised.size() != 1 || ended && !closed) {
                faults.add("the encounter %s, which %s, has the alarms %s"
                        .formatted(pair, ended ? "has ended" : "is ongoing", raised));
            }
        });
        return faults;
    }

    /** Muted and inhibited alarms are delivered later, or never if they were closed meanwhile. */
    private boolean isUndelivered(JsonNode alarm) {
        String id = alarm.path("alarm").asText();
        boolean suppressed = alarm.hasNonNull("mutedUntil") || alarm.hasNonNull("inhibitedBy");
        boolean closed = alarm.path("state").asText().equals("closed");
        boolean required = closed ? farm.receiver.has(id) || !suppressed : !suppressed;
        return required && !farm.receiver.has(id, alarm.path("sequence").asLong());
    }
}
