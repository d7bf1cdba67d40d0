package io.furrow.cli.control;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.TextNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.DevicePage;
import io.furrow.cli.control.table.RecordPage;
import io.furrow.cli.option.CommandGroup;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** {@code ./furrow device}. */
@Command(
        name = "device",
        description = "Lists devices with their status and reports, sends them commands, and gives them credentials.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND")
public final class DeviceCommandGroup extends CommandGroup {
    private static final String DEVICES = "/api/devices";
    private static final String VALUE =
            "What it says beside: a number, true, false, null, an object or a list as JSON, all else as text; \"3\" in quotation marks is a text.";
    private static final String ID = "Id of the device's entity, as in urn:ngsi-ld:Thermometer:weeding-1.";

    @Command(name = "list", description = "Lists devices: status, last report, battery, whether silent.")
    int list(
            @Mixin ControlOptions control,
            @Mixin ListOptions list,
            @Option(names = "--domain", paramLabel = "DOMAIN", description = "Only those of this domain.")
                    String domain,
            @Option(names = "--mission", paramLabel = "MISSION", description = "Only those of this mission.")
                    String mission) {
        Map<String, String> only = new LinkedHashMap<>();
        only.put("domain", domain);
        only.put("mission", mission);
        return list.show(
                control,
                DEVICES + ControlApi.query(only),
                new ControlTable("There are no such devices.")
                        .text("DEVICE", "/id")
                        .text("TYPE", "/type")
                        .text("MISSION", "/mission")
                        .text("WANTED", "/wanted")
                        .text("STATE", "/status/state")
                        .time("LAST SEEN", "/health/lastSeen")
                        .text("BATTERY", "/health/battery")
                        .text("SILENT", "/health/silent")
                        .text("REASON", "/status/reason"),
                Stream.concat(
                                Stream.ofNullable(mission).map(name -> "/api/missions" + ControlApi.part(name)),
                                Stream.ofNullable(domain).map(name -> "/api/domains" + ControlApi.part(name)))
                        .toArray(String[]::new));
    }

    @Command(name = "show", description = "Shows one device: why it is silent, its last report, its connection.")
    int show(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DEVICE", description = ID) String device,
            @Mixin DeviceScope scope) {
        return control.showPage(
                DEVICES + ControlApi.part(device) + scope.query(), shown -> DevicePage.of(shown, Instant.now()));
    }

    @Command(name = "tail", description = "Prints the newest reports of a device: their times and attributes.")
    int tail(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DEVICE", description = ID) String device,
            @Mixin RecordTail tail) {
        return tail.print(control, Topics.RAW, device, RecordPage::report);
    }

    @Command(
            name = "credentials",
            description = {
                "Shows what a device needs to report over MQTT: broker, login, topics, payloads and an example. Of "
                        + "all real devices of a mission with --mission, also as csv or env."
            })
    int credentials(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DEVICE", description = ID, arity = "0..1") String device,
            @Option(names = "--mission", paramLabel = "MISSION", description = "All real devices of this mission.")
                    String mission,
            @Mixin DeviceScope scope) {
        if ((device == null) == (mission == null)) {
            throw control.refused("Name a device, or a mission with --mission.");
        }
        return control.showCredentials(
                device == null
                        ? "/api/missions" + ControlApi.part(mission) + "/credentials"
                        : DEVICES + ControlApi.part(device) + "/credentials" + scope.query());
    }

    @Command(
            name = "rotate",
            description = {
                "Gives a device a new password and shows its credentials.",
                "The old password is refused at once, and its connection is closed; other devices are not affected."
            })
    int rotate(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DEVICE", description = ID) String device,
            @Mixin DeviceScope scope) {
        return control.commandShown("POST", DEVICES + ControlApi.part(device) + "/credentials" + scope.query());
    }

    @Command(name = "on", description = "Switches devices on.")
    int on(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DEVICE", arity = "1..*", description = ID) List<String> devices,
            @Mixin DeviceScope scope) {
        return commands(control, devices, Map.of("command", "on"), scope);
    }

    @Command(name = "off", description = "Switches devices off.")
    int off(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DEVICE", arity = "1..*", description = ID) List<String> devices,
            @Mixin DeviceScope scope) {
        return commands(control, devices, Map.of("command", "off"), scope);
    }

    @Command(name = "restart", description = "Restarts devices.")
    int restart(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DEVICE", arity = "1..*", description = ID) List<String> devices,
            @Mixin DeviceScope scope) {
        return commands(control, devices, Map.of("command", "restart"), scope);
    }

    @Command(name = "command", description = "Sends a device any command, as Stop to a robot.")
    int command(
            @Mixin ControlOptions control,
            @Parameters(index = "0", paramLabel = "DEVICE", description = ID) String device,
            @Parameters(index = "1", paramLabel = "COMMAND", description = "The command.") String command,
            @Parameters(index = "2", paramLabel = "VALUE", arity = "0..1", description = VALUE) String value,
            @Option(
                            names = "--type",
                            paramLabel = "TYPE",
                            description =
                                    "Type of its entity; required for a device that reports by itself, such as ROBOT.")
                    String type,
            @Mixin DeviceScope scope) {
        Map<String, Object> body = new LinkedHashMap<>();
        body.put("type", type);
        body.put("command", command);
        body.put("value", value == null ? null : valueOf(value));
        return commands(control, List.of(device), body, scope);
    }

    private static int commands(ControlOptions control, List<String> devices, Map<String, ?> body, DeviceScope scope) {
        List<String> paths = devices.stream()
                .map(device -> DEVICES + ControlApi.part(device) + "/commands" + scope.query())
                .toList();
        return control.commands("POST", paths, ControlOptions.object(body));
    }

    /** Parses JSON, else returns the value as text. */
    static JsonNode valueOf(String value) {
        try {
            return NgsiJson.read(value.getBytes(StandardCharsets.UTF_8));
        } catch (UnreadableException e) {
            return TextNode.valueOf(value);
        }
    }
}
