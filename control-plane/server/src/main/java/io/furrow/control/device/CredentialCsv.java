package io.furrow.control.device;

import java.util.ArrayList;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.StreamSupport;

import com.fasterxml.jackson.databind.JsonNode;

/** Writes credentials of devices as CSV (RFC 4180), for spreadsheets and programs that set up many devices. */
public final class CredentialCsv {
    public static final String TYPE = "text/csv";

    private static final List<String> COLUMNS =
            List.of("device deviceId host port tls user password apiKey measures commands results".split(" "));

    private CredentialCsv() {}

    /** Returns a header line and one line per device. @param devices of {@link DeviceCredentials#of} */
    public static String of(Iterable<? extends JsonNode> devices) {
        StringBuilder csv = new StringBuilder(String.join(",", COLUMNS) + ",attributes,example\r\n");
        for (JsonNode device : devices) {
            List<String> cells = new ArrayList<>();
            COLUMNS.forEach(column -> cells.add(device.path(column).asText()));
            cells.add(StreamSupport.stream(device.path("attributes").spliterator(), false)
                    .map(each -> each.path("object_id").asText() + "="
                            + each.path("name").asText())
                    .collect(Collectors.joining(" ")));
            cells.add(device.path("example").asText());
            csv.append(cells.stream().map(CredentialCsv::quoted).collect(Collectors.joining(",")))
                    .append("\r\n");
        }
        return csv.toString();
    }

    private static String quoted(String cell) {
        return cell.matches("[^\",\r\n]*") ? cell : '"' + cell.replace("\"", "\"\"") + '"';
    }
}
