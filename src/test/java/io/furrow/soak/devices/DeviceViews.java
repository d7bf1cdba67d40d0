package io.furrow.soak.devices;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.function.BiFunction;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.soak.control.Until;

/** Checks what {@code ./furrow device show}, missions and alarms report about the devices. */
record DeviceViews(UpProcess up, ProgramPlan plan, CheckResults checkResults) {
    private static final Duration TIMEOUT = Duration.ofSeconds(60);
    private static final long CLOCK_TOLERANCE_MILLIS = 5_000;
    private static final long SILENT_WITHOUT_A_PERIOD_MILLIS = 180_000;

    /** Each mission runs; of the mission with faulty devices, those are missing whose reports do not arrive. */
    void missions() {
        List<String> differences = new ArrayList<>();
        int up = 0;
        for (ProgramPlan.Mission mission : plan.missions()) {
            int reporting = (int) mission.devices().stream()
                    .filter(ProgramPlan.Device::reports)
                    .count();
            up += reporting;
            Until.within(
                    TIMEOUT,
                    () -> state(mission.name())
                            .equals("running, %d of %d"
                                    .formatted(reporting, mission.devices().size())));
            String state = state(mission.name());
            if (!state.equals(
                    "running, %d of %d".formatted(reporting, mission.devices().size()))) {
                differences.add("%s: %s".formatted(mission.name(), state));
            }
        }
        Set<String> missing = missing();
        plan.devices().stream()
                .filter(each -> each.reports() == missing.contains(each.id()))
                .forEach(each -> differences.add("missing, or not: " + each.id()));
        checkResults.add(
                "missions run", "%d devices are up, %d named as missing".formatted(up, missing.size()), differences);
    }

    private String state(String mission) {
        JsonNode status = up.get("/api/missions/" + mission).path("status");
        return "%s, %d of %d"
                .formatted(
                        status.path("state").asText(),
                        status.path("confirmed").asInt(),
                        status.path("devices").asInt());
    }

    private Set<String> missing() {
        Set<String> missing = new HashSet<>();
        Until.within(TIMEOUT, () -> {
            up.get("/api/missions/" + ProgramPlan.FAULTY)
                    .at("/status/missing")
                    .forEach(each -> missing.add(
                            each.path("device").asText(each.path("id").asText())));
            return !missing.isEmpty();
        });
        return missing;
    }

    /**
     * Each device without a fault has a login, is registered at the agent, has a correct clock, and no cause of
     * silence.
     */
    void healthyDevices(String when) throws IOException, InterruptedException {
        check(
                "device show of the others, " + when,
                plan.devices().stream().filter(ProgramPlan.Device::isHealthy).toList(),
                (device, shown) -> shown.at("/connection/loggedIn").isTextual()
                                && shown.at("/connection/registered").asBoolean()
                                && !shown.path("connection").has("cause")
                                && Math.abs(shown.at("/connection/lastReport/offset")
                                                .asLong())
                                        < CLOCK_TOLERANCE_MILLIS
                        ? null
                        : shown.path("connection").toString());
    }

    /** The faults as far as Mosquitto's log and the control plane's clock reveal them. */
    void faultsBesideMosquitto(String when) throws IOException, InterruptedException {
        for (String fault : List.of("password", "topic", "json", "clock")) {
            check("device show of a wrong " + fault + ", " + when, faulty(fault), (device, shown) -> {
                JsonNode connection = shown.path("connection");
                String cause = connection.path("cause").asText();
                boolean named = connection.path("registered").asBoolean()
                        && switch (fault) {
                            case "password" ->
                                cause.startsWith("it has not connected to the MQTT broker since")
                                        && !connection.has("loggedIn");
                            case "topic" -> cause.contains("where it may not") && cause.contains("to /of-another/");
                            case "json" -> cause.contains("and has sent nothing since") && connection.has("loggedIn");
                            default -> hasOffset(device, connection);
                        };
                return named ? null : connection.toString();
            });
        }
    }

    /** The faults as the suite's own broker and agent detect them. */
    void faultsOfTheSuite() throws IOException, InterruptedException {
        for (String fault : List.of("password", "topic", "json", "clock")) {
            check("its own broker and agent: wrong " + fault, faulty(fault), (device, shown) -> {
                JsonNode connection = shown.path("connection");
                String cause = connection.path("cause").asText();
                boolean named = connection.path("registered").asBoolean()
                        && switch (fault) {
                            case "password" ->
                                cause.startsWith("its password was refused")
                                        && connection
                                                .at("/refusedLogin/reason")
                                                .asText()
                                                .equals("wrong-password")
                                        && connection.at("/refusedLogin/count").asInt() > 1;
                            case "topic" ->
                                cause.contains("to /of-another/")
                                        && connection.at("/foreignTopic/count").asInt() > 0;
                            case "json" ->
                                cause.contains("could not be read")
                                        && connection
                                                .at("/unreadablePayload/payload")
                                                .asText()
                                                .startsWith("{\"time\"")
                                        && !connection
                                                .at("/unreadablePayload/reason")
                                                .asText()
                                                .isEmpty();
                            default -> hasOffset(device, connection);
                        };
                return named ? null : connection.toString();
            });
        }
    }

    private static boolean hasOffset(ProgramPlan.Device device, JsonNode connection) {
        long ahead = device.behavior().path("ahead").asLong();
        return connection.has("loggedIn")
                && Math.abs(connection.at("/lastReport/offset").asLong() + ahead) < CLOCK_TOLERANCE_MILLIS;
    }

    private List<ProgramPlan.Device> faulty(String fault) {
        return plan.devices().stream()
                .filter(each -> each.fault().equals(fault))
                .toList();
    }

    /**
     * Reads the first device with the command, the others over REST.
     *
     * @param difference compares a device with what is shown; null if there is no difference
     */
    private void check(
            String what, List<ProgramPlan.Device> devices, BiFunction<ProgramPlan.Device, JsonNode, String> difference)
            throws IOException, InterruptedException {
        Until.within(TIMEOUT, () -> devices.stream().allMatch(each -> difference.apply(each, show(each)) == null));
        List<String> differences = new ArrayList<>();
        String example = "";
        for (ProgramPlan.Device each : devices) {
            JsonNode shown = each == devices.get(0)
                    ? JsonReader.read(up.run("device", "show", each.id(), "--output", "json"))
                    : show(each);
            example = shown.at("/connection/cause")
                    .asText("offset of a clock %d ms"
                            .formatted(shown.at("/connection/lastReport/offset").asLong()));
            String differs = difference.apply(each, shown);
            if (differs != null) {
                differences.add(each.id() + ": " + differs);
            }
        }
        checkResults.add(what, "%d devices: %s".formatted(devices.size(), example), differences);
    }

    private JsonNode show(ProgramPlan.Device device) {
        return up.get("/api/v1/devices/" + device.id());
    }

    /**
     * No alarm of a silent device is open, except for devices whose reports do not arrive.
     *
     * @param quiet devices that have not reported for so long that others would count as silent
     */
    void noHealthyDeviceIsSilent(List<ProgramPlan.Device> quiet) {
        Until.within(TIMEOUT.multipliedBy(3), () -> silent().isEmpty());
        List<String> differences = new ArrayList<>(silent());
        long now = System.currentTimeMillis();
        long min = Long.MAX_VALUE;
        for (ProgramPlan.Device each : quiet) {
            min = Math.min(
                    min,
                    now
                            - up.get("/api/devices/" + each.id())
                                    .at("/health/heard")
                                    .asLong());
        }
        if (min < SILENT_WITHOUT_A_PERIOD_MILLIS) {
            differences.add("the quiet devices were not quiet for long enough");
        }
        checkResults.add(
                "no healthy device counts as silent",
                "%d devices with a period of 15 min have not reported for %d s or more"
                        .formatted(quiet.size(), min / 1000),
                differences);
    }

    private List<String> silent() {
        List<String> silent = new ArrayList<>();
        for (JsonNode device : up.get("/api/devices")) {
            boolean healthy = !device.path("mission").asText().equals(ProgramPlan.FAULTY);
            if (healthy && device.at("/health/silent").asBoolean()) {
                silent.add(device.path("id").asText());
            }
        }
        for (JsonNode alarm : up.get("/api/alarms?state=open")) {
            boolean ofFaulty = alarm.path("group").asText().contains(ProgramPlan.FAULTY)
                    || alarm.path("subject").asText().contains(ProgramPlan.FAULTY);
            if (alarm.path("kind").asText().startsWith("silent") && !ofFaulty) {
                silent.add(alarm.path("text").asText());
            }
        }
        return silent;
    }
}
