package io.furrow.cli.control;

import java.time.Instant;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.MissingNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.StatusPage;
import io.furrow.cli.option.HelpOption;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/** {@code ./furrow status}. */
@Command(
        name = "status",
        abbreviateSynopsis = true,
        description = {
            "Shows how it is: parts that are not up, missions by state, open alarms, dead letters, and the lag of the "
                    + "jobs where --api is the dashboard.",
            "Exit code 0 if all parts are up."
        })
public final class StatusCommand implements Callable<Integer> {
    private final ObjectNode status = NgsiJson.object();

    @Mixin
    private ControlOptions control;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() {
        status.removeAll();
        int code = control.run(api -> {
            read(api);
            control.print(status, shown -> StatusPage.of(shown, Instant.now()));
        });
        return code == 0 && !status.path("status").asText().equals("ready") ? 1 : code;
    }

    private void read(ControlApi api) {
        JsonNode platform = platform(api);
        JsonNode ready = platform.isMissingNode() ? api.ready() : platform.path("controlPlane");
        for (String member : List.of("status", "reason", "warnings", "parts")) {
            if (ready.has(member)) {
                status.set(member, ready.get(member));
            }
        }
        add("missions", () -> counts(api.once("/api/missions"), "/status/state"));
        add("alarms", () -> counts(api.once("/api/alarms?state=open"), "/severity"));
        add("deadLetters", () -> deadLetters(api.once("/api/v1/topics")));
        if (platform.at("/kafka/reason").isTextual()) {
            status.set("lag", platform.at("/kafka/reason"));
        } else if (!platform.isMissingNode()) {
            ObjectNode lag = status.putObject("lag");
            platform.path("groups").forEach(group -> lag.set(group.path("group").asText(), group.path("lag")));
        }
    }

    /** Returns what the dashboard has of Kafka and the control plane; nothing if this is the control plane itself. */
    private static JsonNode platform(ControlApi api) {
        try {
            return api.once("/api/platform");
        } catch (ControlPlaneException e) {
            if (e.isUnknown()) {
                return MissingNode.getInstance();
            }
            throw e;
        }
    }

    /** Adds a part of it, or why it cannot be read. */
    private void add(String name, Supplier<JsonNode> part) {
        try {
            status.set(name, part.get());
        } catch (ControlPlaneException e) {
            status.put(name, e.getMessage());
        }
    }

    private static ObjectNode counts(JsonNode answer, String place) {
        ObjectNode counts = NgsiJson.object();
        ControlTable.rows(answer).forEach(row -> {
            String value = row.at(place).asText("unknown");
            counts.put(value, counts.path(value).asInt() + 1);
        });
        return counts;
    }

    private static ObjectNode deadLetters(JsonNode topics) {
        ObjectNode letters = NgsiJson.object();
        ControlTable.rows(topics).forEach(topic -> {
            String name = topic.path("topic").asText();
            if (Topics.ofDeadLetters(name).isPresent() && topic.path("records").asLong() > 0) {
                letters.set(name, topic.path("records"));
            }
        });
        return letters;
    }
}
