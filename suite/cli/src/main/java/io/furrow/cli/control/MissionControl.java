package io.furrow.cli.control;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.node.TextNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.DeviceListParts;
import io.furrow.cli.control.table.JsonFile;
import io.furrow.cli.control.table.MissionPage;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.option.Confirmation;
import io.furrow.cli.time.TimeConverter;
import io.furrow.cli.time.Times;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.Counts;

/** The commands of {@code ./furrow mission} that use the control plane. */
@Command(addMethodSubcommands = false)
public class MissionControl extends CommandGroup {
    private static final String MISSIONS = "/api/missions";
    private static final String NAME = "Name of the mission: 1 to 64 of A-Z a-z 0-9 _ -.";

    /** The devices of a mission. */
    static final class Plan {
        @Option(names = "--template", paramLabel = "NAME", description = "Template, NAME or NAME@VERSION.")
        private String template;

        @Option(
                names = "--devices",
                paramLabel = "FILE|JSON",
                description =
                        "JSON list of its devices: a file, or the list itself, as '[{\"type\": \"Thermometer\"}]'.")
        private String devices;

        ObjectNode json(String mission, String domain) throws IOException {
            ObjectNode json = NgsiJson.mapper().createObjectNode().put("mission", mission);
            if (domain != null) {
                json.put("domain", domain);
            }
            if (template != null) {
                json.put("template", template);
            }
            if (devices != null) {
                json.set("devices", JsonFile.readOrParse(devices));
            }
            return json;
        }
    }

    @Command(name = "list", description = "Lists missions with their state.")
    int list(
            @Mixin ControlOptions control,
            @Mixin ListOptions list,
            @Option(names = "--domain", paramLabel = "DOMAIN", description = "Only those of this domain.")
                    String domain) {
        return list.show(
                control,
                path(domain),
                new ControlTable("There is no mission; ./furrow mission create makes one.")
                        .text("MISSION", "/mission")
                        .text("DOMAIN", "/domain")
                        .text("TEMPLATE", "/template")
                        .text("STATE", "/status/state")
                        .text("UP", MissionControl::up)
                        .text("DEVICES", "/deviceCount")
                        .time("SINCE", "/status/since")
                        .text("NEXT", MissionControl::next)
                        .text("REASON", "/status/reason"),
                Stream.ofNullable(domain)
                        .map(name -> "/api/domains" + ControlApi.part(name))
                        .toArray(String[]::new));
    }

    /** The path of the missions. @param domain null for those of all */
    static String path(String domain) {
        return domain == null ? MISSIONS : MISSIONS + ControlApi.query(Map.of("domain", domain));
    }

    /** Otherwise the devices in the desired state are those that have stopped. */
    private static JsonNode up(JsonNode mission) {
        String state = mission.at("/status/state").asText();
        return mission.at(state.equals("starting") || state.equals("running") ? "/status/confirmed" : "/none");
    }

    private static JsonNode next(JsonNode mission) {
        boolean waits = mission.at("/status/state").asText().equals("created");
        JsonNode time = mission.at(waits ? "/status/due" : "/status/ends");
        return time.isNumber() ? TextNode.valueOf((waits ? "starts " : "ends ") + Times.of(time)) : time;
    }

    @Command(name = "show", description = "Shows one mission: its state, missing devices and why they are missing.")
    int show(@Mixin ControlOptions control, @Parameters(paramLabel = "MISSION", description = NAME) String mission) {
        return control.showPage(MISSIONS + ControlApi.part(mission), shown -> MissionPage.of(shown, Instant.now()));
    }

    @Command(name = "create", description = "Creates a mission without starting it.")
    int create(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "MISSION", description = NAME) String mission,
            @Option(names = "--domain", paramLabel = "DOMAIN", required = true, description = "Its domain.")
                    String domain,
            @Mixin Plan plan) {
        return control.run(api -> control.answered(create(api, plan.json(mission, domain))));
    }

    /** Splits a list that is too long for one request. */
    static JsonNode create(ControlApi api, ObjectNode plan) {
        List<ObjectNode> parts = DeviceListParts.requests(plan);
        if (parts.size() == 1) {
            return api.send("POST", MISSIONS, plan);
        }
        JsonNode answer = api.send("POST", MISSIONS, plan.deepCopy().without("devices"));
        String path = MISSIONS + ControlApi.part(plan.path("mission").asText()) + "/devices";
        parts.forEach(part -> api.send("POST", path, part));
        return answer;
    }

    @Command(
            name = "add-devices",
            description = "Adds devices to a mission that is not running. Devices that it already has stay.")
    int addDevices(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "MISSION", description = NAME) String mission,
            @Parameters(paramLabel = "FILE", description = "JSON list of devices.") Path devices) {
        return control.run(api -> {
            ObjectNode list = NgsiJson.mapper().createObjectNode().set("devices", JsonFile.read(devices));
            JsonNode answer = null;
            for (ObjectNode part : DeviceListParts.requests(list)) {
                answer = api.send("POST", MISSIONS + ControlApi.part(mission) + "/devices", part);
            }
            control.answered(answer);
        });
    }

    @Command(name = "start", description = "Starts a mission; creates it if it does not exist.")
    int start(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "MISSION", description = NAME) String mission,
            @Mixin Begin begin,
            @Mixin Plan plan,
            @Mixin Wait wait) {
        int code = control.run(api -> {
            ObjectNode json = plan.json(mission, begin.domain);
            if (DeviceListParts.requests(json).size() > 1) {
                create(api, json);
                json.remove("devices");
            }
            control.answered(api.send("POST", MISSIONS + ControlApi.part(mission) + "/start", begin.in(json)));
        });
        return code == 0 ? wait.until(control, List.of(mission), "running") : code;
    }

    /** Start, duration and domain of a mission. */
    static final class Begin {
        @Option(names = "--domain", paramLabel = "DOMAIN", description = "Its domain; required for a new mission.")
        private String domain;

        @Option(
                names = "--at",
                paramLabel = "TIME",
                converter = TimeConverter.Next.class,
                description = "When, as 06:00, +2h or 2026-05-01T06:00:00. Default: now.")
        private Instant at;

        @Option(names = "--duration", paramLabel = "DURATION", description = "Stopped after this, as 2h or 1h30m.")
        private Duration duration;

        ObjectNode in(ObjectNode json) {
            if (at != null) {
                json.put("start", at.toEpochMilli());
            }
            return duration == null ? json : json.put("duration", duration.toString());
        }
    }

    @Command(
            name = "stop",
            description =
                    "Stops missions: those that are named, or those of a domain or all that run or are scheduled.")
    int stop(
            @Mixin ControlOptions control,
            @Mixin MissionChoice choice,
            @Mixin Wait wait,
            @Mixin Confirmation confirmation) {
        choice.check(control);
        List<String> stopped = new ArrayList<>();
        int code = control.each(api -> choice.names(control, api, confirmation, "Stop"), (api, mission) -> {
            control.done(api.send("POST", MISSIONS + ControlApi.part(mission) + "/stop", null), "stopped");
            stopped.add(mission);
        });
        return Math.max(code, wait.until(control, stopped, "stopped"));
    }

    /** The options to wait for the end of a start or stop. */
    static final class Wait {
        @Option(
                names = "--wait",
                description = "Wait until it is done, and print the progress. Exit code 1 if it fails or takes longer.")
        private boolean wait;

        @Option(
                names = "--timeout",
                paramLabel = "DURATION",
                defaultValue = "10m",
                description = "How long --wait waits at most. Default: ${DEFAULT-VALUE}.")
        private Duration timeout;

        /** Returns the exit code. */
        int until(ControlOptions control, List<String> missions, String state) {
            return wait ? MissionWatch.await(control, missions, state, timeout) : 0;
        }
    }

    @Command(name = "delete", description = "Deletes missions that do not run. Their recordings stay.")
    int delete(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "MISSION", arity = "1..*", description = NAME) List<String> missions,
            @Mixin Confirmation confirmation) {
        confirmation.ask("Delete %s?".formatted(Confirmation.named("mission", missions)));
        return control.commands(
                "DELETE",
                missions.stream().map(each -> MISSIONS + ControlApi.part(each)).toList(),
                null);
    }

    @Command(
            name = "purge",
            description = {
                "Deletes the stored events and markers of missions, which no replay can play then. For admins; refused "
                        + "while a mission or a replay of it runs. Events that arrive later are stored again.",
                "Images stay; ./furrow images purge deletes them."
            })
    int purge(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "MISSION", arity = "1..*", description = "As 'replay missions' lists it.")
                    List<String> missions,
            @Option(names = "--dry-run", description = "Show what would be deleted and delete nothing.") boolean dryRun,
            @Mixin Confirmation confirmation) {
        return control.each(api -> missions, (api, mission) -> {
            String path = "/api/recordings" + ControlApi.part(mission);
            if (dryRun) {
                control.done(api.send("DELETE", path + "?dryRun=true", null), "would be deleted");
                return;
            } else if (confirmation.isAsked()) {
                JsonNode found = api.send("DELETE", path + "?dryRun=true", null);
                confirmation.ask("Delete %s and %s of mission %s?"
                        .formatted(
                                Counts.of(found.path("events").asLong(), "event"),
                                Counts.of(found.path("markers").asLong(), "marker"),
                                mission));
            }
            control.answered(api.send("DELETE", path, null));
        });
    }

    @Command(
            name = "watch",
            description = {
                "Prints a line for each change of a mission until it has stopped or failed.",
                "Exit code 0 means that it reached the state of --until."
            })
    int watch(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "MISSION", description = NAME) String mission,
            @Option(
                            names = "--until",
                            paramLabel = "STATE",
                            defaultValue = "stopped",
                            description = "Ends with this state, for instance running. Default: ${DEFAULT-VALUE}.")
                    String until) {
        return new MissionWatch(control, mission, until).run();
    }
}
