package io.furrow.cli.command;

import java.io.IOException;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.field.FieldList;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.option.Confirmation;
import io.furrow.cli.option.KafkaOptions;
import io.furrow.cli.time.Times;
import io.furrow.kafka.field.FieldChange;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow fields}. */
@Command(
        name = "fields",
        description = {
            "Imports, lists, renames, ends and deletes the fields of the farm.",
            "With --kafka, list and import use the topic service.fields itself, past the control plane."
        },
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND",
        subcommands = FieldsImportCommand.class)
public final class FieldsCommandGroup extends CommandGroup {
    static final String FIELDS = "/api/fields";

    private static final String ID = "Id of the field; ./furrow fields list shows it.";

    @Command(name = "list", description = "Prints the fields as of a time.")
    int list(
            @Mixin ControlOptions control,
            @Mixin KafkaOptions kafka,
            @Mixin ListLimit limit,
            @Option(
                            names = "--at",
                            paramLabel = "TIME",
                            description = "Event time, for instance 2026-03-01T00:00:00Z. Default: now.")
                    Instant at,
            @Option(names = "--versions", description = "All versions of all times, including ends.")
                    boolean versions) {
        Map<String, Object> query = new LinkedHashMap<>();
        query.put("at", at);
        query.put("versions", versions ? true : null);
        limit.check(control);
        return control.run(api -> {
            ControlApi.Page listed = control.isGiven("--kafka")
                    ? limit.cut(stored(kafka, at, versions))
                    : limit.read(api, FIELDS + ControlApi.query(query));
            control.print(FieldList.json(listed.elements()), FieldList::lines, FieldList::names);
            limit.remark(control, listed);
        });
    }

    private static ArrayNode stored(KafkaOptions kafka, Instant at, boolean versions) throws IOException {
        List<FieldVersion> all = new FieldsTopic(kafka.client()).read();
        Instant time = at == null ? Instant.now() : at;
        return FieldList.features(
                versions
                        ? all
                        : List.copyOf(FieldChange.asOf(time.toEpochMilli(), all).values()));
    }

    @Command(name = "rename", description = "Renames a field in all its versions; its id stays.")
    int rename(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "ID", description = ID) String id,
            @Option(names = "--name", paramLabel = "NAME", required = true, description = "Name for people.")
                    String name) {
        return control.run(api -> control.answered(
                api.send("PATCH", path(id), NgsiJson.mapper().createObjectNode().put("name", name)),
                "Field %s is now called %s.".formatted(id, name)));
    }

    @Command(
            name = "end",
            description = {
                "Ends a field: from a time on it has no averages and stays.",
                "Earlier results stay, and a replay of an earlier time has the field as it was. Versions that begin after that"
                        + " time are removed."
            })
    int end(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "ID", description = ID) String id,
            @Option(
                            names = "--at",
                            paramLabel = "TIME",
                            description = "Event time of its end, for instance 2026-10-01T00:00:00Z. Default: now.")
                    Instant at) {
        Instant end = (at == null ? Instant.now() : at).truncatedTo(ChronoUnit.MILLIS);
        return control.run(api -> control.answered(
                api.send("PATCH", path(id), NgsiJson.mapper().createObjectNode().put("validTo", end.toString())),
                "Field %s ends at %s.".formatted(id, Times.of(end.toEpochMilli()))));
    }

    @Command(
            name = "delete",
            description = {
                "Deletes a field with all its versions, as if it had never existed; this cannot be undone.",
                "Stored averages and stays of it remain under its id; a replay of an earlier time has no new ones. "
                        + "To keep the past, end the field instead."
            })
    int delete(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "ID", description = ID) String id,
            @Mixin Confirmation confirmation) {
        confirmation.ask("Delete field %s with all its versions, as if it had never existed?".formatted(id));
        return control.run(api -> {
            JsonNode answer = api.send("DELETE", path(id), null);
            int versions = answer.path("versions").asInt();
            control.answered(
                    answer,
                    "Field %s is deleted, with %s."
                            .formatted(id, versions == 1 ? "its one version" : "its %d versions".formatted(versions)));
        });
    }

    private static String path(String id) {
        return FIELDS + ControlApi.part(id);
    }
}
