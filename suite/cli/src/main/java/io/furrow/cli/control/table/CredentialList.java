package io.furrow.cli.control.table;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.stream.Collectors;
import java.util.stream.StreamSupport;

import com.fasterxml.jackson.databind.JsonNode;

/** Prints credentials of devices as text: as a table, and as variables of a shell. */
public final class CredentialList {
    private static final List<String> COLUMNS =
            List.of("device deviceId host port tls user password apiKey measures commands results".split(" "));

    private CredentialList() {}

    /** The table of many devices; further members of a device, such as its example, are in the other formats. */
    public static ControlTable table() {
        return new ControlTable(
                        "The mission has no real device with a login; its devices have theirs while it is started.")
                .text("DEVICE", "/device")
                .text("HOST", "/host")
                .text("PORT", "/port")
                .text("USER", "/user")
                .text("PASSWORD", "/password")
                .text("MEASURES", "/measures");
    }

    /** Variables of each device for {@code . file}, devices separated by an empty line. */
    public static List<String> env(JsonNode devices) {
        List<String> lines = new ArrayList<>();
        for (JsonNode device : devices) {
            if (!lines.isEmpty()) {
                lines.add("");
            }
            COLUMNS.stream()
                    .filter(device::has)
                    .forEach(column -> lines.add("MQTT_%s='%s'"
                            .formatted(
                                    column.replaceAll("([A-Z])", "_$1").toUpperCase(Locale.ROOT),
                                    device.path(column).asText().replace("'", "'\\''"))));
            lines.add("MQTT_ATTRIBUTES='%s'".formatted(attributes(device)));
        }
        return lines;
    }

    /** {@code temp=Temperature lat=Latitude}. */
    private static String attributes(JsonNode device) {
        return StreamSupport.stream(device.path("attributes").spliterator(), false)
                .map(each -> each.path("object_id").asText() + "="
                        + each.path("name").asText())
                .collect(Collectors.joining(" "));
    }
}
