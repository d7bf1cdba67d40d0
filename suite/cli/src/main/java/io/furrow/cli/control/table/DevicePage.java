package io.furrow.cli.control.table;

import java.time.Duration;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;
import io.furrow.model.text.Counts;

/** Prints a device as lines {@code label: value}: its properties, its last contact, and why it is silent. */
public final class DevicePage {
    /** A smaller difference is attributed to latency. */
    private static final Duration RIGHT = Duration.ofSeconds(5);

    private final JsonNode device;
    private final JsonNode connection;
    private final PageLines page;

    private DevicePage(JsonNode device, Instant now) {
        this.device = device;
        this.connection = device.path("connection");
        this.page = new PageLines(now);
    }

    /** @param device as the REST API has it */
    public static List<String> of(JsonNode device, Instant now) {
        return new DevicePage(device, now).all();
    }

    private List<String> all() {
        if (isSilent()) {
            add("Silent", connection.path("cause").asText("it has not reported yet"));
        }
        add("Device", device.path("id").asText());
        boolean simulated = device.path("simulated").booleanValue();
        add("Type", device.path("type").asText("not known") + (simulated ? ", simulated" : ", real"));
        add("Mission", "%s of domain %s".formatted(text(device.path("mission")), text(device.path("domain"))));
        add("Wanted", device.path("wanted").asText());
        add("State", device.at("/status/state").asText("not known") + PageLines.reason(device.at("/status/reason")));
        report(connection.path("lastReport"));
        if (device.at("/health/battery").isNumber()) {
            add("Battery", Math.round(device.at("/health/battery").doubleValue() * 100) + " %");
        }
        login();
        refusals(connection.path("refusedLogin"));
        unreadable(connection.path("unreadablePayload"));
        foreign(connection.path("foreignTopic"));
        if (connection.has("registered")) {
            add("IoT Agent", connection.path("registered").booleanValue() ? "knows it" : "does not know it");
        }
        return page.all();
    }

    private boolean isSilent() {
        boolean runs = device.path("wanted").asText().equals("running");
        boolean lastReport = device.at("/health/heard").longValue()
                >= Math.max(1, device.path("from").longValue());
        boolean off = device.at("/health/off").booleanValue();
        return runs && !off && (!lastReport || device.at("/health/silent").booleanValue());
    }

    private void report(JsonNode report) {
        if (report.isMissingNode()) {
            add("Last report", "none yet");
            return;
        }
        add(
                "Last report",
                "of %s, received %s".formatted(Times.of(report.path("time")), page.ago(report.path("received"))));
        Duration offset = Duration.ofMillis(report.path("offset").longValue());
        add(
                "Clock",
                offset.abs().compareTo(RIGHT) < 0
                        ? "its clock is right within " + RIGHT.toSeconds() + " s"
                        : "its clock is %s %s"
                                .formatted(arguments(offset.abs()), offset.isNegative() ? "ahead" : "behind"));
    }

    private void login() {
        JsonNode since = connection.path("since");
        if (connection.hasNonNull("loggedIn")) {
            add("Last login", page.ago(connection.path("loggedIn")));
        } else if (!since.isMissingNode()) {
            add("Last login", "none since " + Times.of(since));
        }
    }

    private void refusals(JsonNode refused) {
        if (!refused.isMissingNode()) {
            boolean unknown = refused.path("reason").asText().equals("unknown-user");
            String user = refused.path("user").asText();
            add(
                    "Refused logins",
                    "%s: %s"
                            .formatted(
                                    counted(refused),
                                    unknown
                                            ? "its user %s does not exist or no longer".formatted(user)
                                            : "wrong password of user " + user));
        }
    }

    private void unreadable(JsonNode unreadable) {
        if (!unreadable.isMissingNode()) {
            add(
                    "Unreadable",
                    "%s: %s; it began with %s"
                            .formatted(
                                    counted(unreadable),
                                    unreadable.path("reason").asText(),
                                    unreadable.path("payload").asText()));
        }
    }

    private void foreign(JsonNode foreign) {
        if (!foreign.isMissingNode()) {
            add(
                    "Foreign topic",
                    "published %s to %s, where it may not"
                            .formatted(counted(foreign), foreign.path("topic").asText()));
        }
    }

    private String counted(JsonNode observed) {
        long count = observed.path("count").longValue();
        return Counts.times(count) + (count == 1 ? ", " : ", last ") + page.ago(observed.path("last"));
    }

    /** Its two greatest units, as {@code 2 h 0 min}. */
    private static String arguments(Duration time) {
        if (time.toMinutes() == 0) {
            return time.toSeconds() + " s";
        } else if (time.toHours() == 0) {
            return "%d min %d s".formatted(time.toMinutes(), time.toSecondsPart());
        }
        return time.toDays() == 0
                ? "%d h %d min".formatted(time.toHours(), time.toMinutesPart())
                : "%d d %d h".formatted(time.toDays(), time.toHoursPart());
    }

    private static String text(JsonNode name) {
        return name.asText().isEmpty() ? "-" : name.asText();
    }

    private void add(String label, String value) {
        page.add(label, value);
    }
}
