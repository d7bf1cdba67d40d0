package io.furrow.cli.control.table;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;
import io.furrow.model.text.Counts;

/** Prints the status of Furrow as lines {@code label: value}: what does not work, before what there is. */
public final class StatusPage {
    private StatusPage() {}

    /** @param status with members {@code status}, {@code parts}, and counts or a reason in the others */
    public static List<String> of(JsonNode status, Instant now) {
        PageLines page = new PageLines(now);
        page.add("Status", status.path("status").asText("unknown") + PageLines.reason(status.path("reason")));
        List<String> names = new ArrayList<>();
        status.path("parts").properties().forEach(part -> {
            if (part.getValue().path("state").asText().equals("up")) {
                names.add(part.getKey());
            } else {
                page.add("Not up", part(part.getKey(), part.getValue()));
            }
        });
        status.path("warnings").forEach(warning -> page.add("Warning", warning.asText()));
        if (!names.isEmpty()) {
            page.add("Parts", Counts.of(names.size(), "part") + " up");
        }
        page.add("Missions", countsFirst(status.path("missions")));
        page.add("Open alarms", countsFirst(status.path("alarms")));
        page.add("Dead letters", namesFirst(status.path("deadLetters")));
        page.add(
                "Lag",
                status.has("lag")
                        ? namesFirst(status.path("lag"))
                        : "the dashboard knows it, for instance --api http://127.0.0.1:8080");
        return page.all();
    }

    private static String part(String name, JsonNode part) {
        String state = "%s, %s".formatted(name, part.path("state").asText());
        String since = part.has("lastSuccess") ? ", last up at " + Times.of(part.path("lastSuccess")) : "";
        return state + since + PageLines.reason(part.path("detail"));
    }

    private static String countsFirst(JsonNode counts) {
        return joined(counts, "%2$s %1$s");
    }

    private static String namesFirst(JsonNode counts) {
        return joined(counts, "%s %s");
    }

    private static String joined(JsonNode counts, String form) {
        if (counts.isTextual()) {
            return "not known: " + counts.textValue();
        }
        return counts.isEmpty()
                ? "none"
                : counts.properties().stream()
                        .map((Map.Entry<String, JsonNode> each) ->
                                form.formatted(each.getKey(), each.getValue().asText()))
                        .collect(Collectors.joining(", "));
    }
}
