package io.furrow.cli.control;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.MissingNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.cli.control.table.JsonFile;
import io.furrow.cli.option.HelpOption;

/** {@code ./furrow apply}. */
@Command(
        name = "apply",
        abbreviateSynopsis = true,
        description = {
            "Creates and changes domains, and creates missions, as JSON files define them.",
            "'domain show' and 'mission show' with -o json print such definitions; a file has one or a list of them. A "
                    + "mission that exists with other devices is refused."
        })
public final class ApplyCommand implements Callable<Integer> {
    private static final String MISSION = "mission";
    private static final String DOMAIN = "domain";
    /** Members of a shown domain or mission that are no part of its definition. */
    private static final List<String> STATE =
            List.of("changed", "created", "deviceCount", "duration", "running", "sequence", "start", "status");

    @Mixin
    private ControlOptions control;

    @Mixin
    private HelpOption help;

    @Parameters(paramLabel = "FILE", arity = "1..*", description = "Files of definitions.")
    private List<String> files;

    @Override
    public Integer call() {
        return control.each(api -> files, this::apply);
    }

    private void apply(ControlApi api, String file) throws IOException {
        JsonNode content = JsonFile.read(Path.of(file));
        for (JsonNode each : content.isArray() ? content : List.of(content)) {
            String kind = each.path(MISSION).isTextual() ? MISSION : DOMAIN;
            if (!(each instanceof ObjectNode definition) || !each.path(kind).isTextual()) {
                throw control.refused(file + ": a definition is an object with a 'domain' or a 'mission'");
            }
            apply(api, kind, definition.without(STATE));
        }
    }

    private void apply(ControlApi api, String kind, ObjectNode definition) throws IOException {
        if (definition.has("devices")) {
            definition.remove("template"); // its devices were copied
        }
        String path =
                "/api/" + kind + "s" + ControlApi.part(definition.path(kind).asText());
        JsonNode existing = existing(api, path);
        if (definition.properties().stream().allMatch(each -> each.getValue().equals(existing.get(each.getKey())))) {
            control.answered(
                    definition,
                    "unchanged: %s %s".formatted(kind, definition.path(kind).asText()));
        } else if (kind.equals(MISSION)) {
            control.answered(MissionControl.create(api, definition));
        } else if (existing.isMissingNode()) {
            control.answered(api.send("POST", "/api/domains", definition));
        } else {
            control.answered(api.send("PATCH", path, definition));
        }
    }

    private static JsonNode existing(ControlApi api, String path) {
        try {
            return api.get(path);
        } catch (ControlPlaneException e) {
            if (!e.isUnknown()) {
                throw e;
            }
            return MissingNode.getInstance();
        }
    }
}
