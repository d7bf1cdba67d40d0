package io.furrow.cli.control;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.StringJoiner;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.JsonFile;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.option.Confirmation;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.Counts;

/** {@code ./furrow domain}. */
@Command(
        name = "domain",
        description = "Creates, changes, lists and deletes domains, to which missions belong.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND")
public final class DomainCommandGroup extends CommandGroup {
    private static final String DOMAINS = "/api/domains";
    private static final String NAME = "Name of the domain: 1 to 64 of A-Z a-z 0-9 _ -.";

    /** The properties of a domain. */
    static final class Details {
        @Option(names = "--name", paramLabel = "TEXT", description = "Name for people.")
        private String name;

        @Option(names = "--description", paramLabel = "TEXT", description = "What it is.")
        private String description;

        @Option(names = "--area", paramLabel = "FILE", description = "GeoJSON Polygon or MultiPolygon of its area.")
        private Path area;

        @Option(
                names = "--fields",
                paramLabel = "ID",
                split = ",",
                description = "Ids of its fields, separated by commas.")
        private List<String> fields;

        ObjectNode json() throws IOException {
            ObjectNode json = NgsiJson.mapper().createObjectNode();
            if (name != null) {
                json.put("name", name);
            }
            if (description != null) {
                json.put("description", description);
            }
            if (area != null) {
                json.set("area", JsonFile.read(area));
            }
            if (fields != null) {
                fields.forEach(json.withArray("fields")::add);
            }
            return json;
        }
    }

    @Command(name = "list", description = "Lists all domains.")
    int list(@Mixin ControlOptions control, @Mixin ListOptions list) {
        return list.show(
                control,
                DOMAINS,
                new ControlTable("There is no domain yet; ./furrow domain create makes one.")
                        .text("DOMAIN", "/domain")
                        .text("NAME", "/name")
                        .text("DESCRIPTION", "/description")
                        .count("FIELDS", "/fields")
                        .time("CREATED", "/created"));
    }

    @Command(name = "show", description = "Shows one domain.")
    int show(@Mixin ControlOptions control, @Parameters(paramLabel = "DOMAIN", description = NAME) String domain) {
        return control.showOne(DOMAINS + ControlApi.part(domain));
    }

    @Command(name = "create", description = "Creates a domain.")
    int create(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DOMAIN", description = NAME) String domain,
            @Mixin Details details) {
        return control.run(
                api -> control.answered(api.send("POST", DOMAINS, details.json().put("domain", domain))));
    }

    @Command(name = "change", description = "Changes a domain; members that are not given stay.")
    int change(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DOMAIN", description = NAME) String domain,
            @Mixin Details details) {
        return control.run(
                api -> control.answered(api.send("PATCH", DOMAINS + ControlApi.part(domain), details.json())));
    }

    @Command(
            name = "delete",
            description = {
                "Deletes a domain with its missions and their devices, and ends its fields; refused while missions "
                        + "run in it.",
                "Recordings of the missions stay as long as missions are stored, and so do results of the fields."
            })
    int delete(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "DOMAIN", description = NAME) String domain,
            @Option(names = "--force", description = "Also if missions run in it; they are stopped.") boolean force,
            @Mixin Confirmation confirmation) {
        String path = DOMAINS + ControlApi.part(domain) + "?force=" + force;
        return control.run(api -> {
            if (confirmation.isAsked()) {
                confirmation.ask(question(domain, api.send("DELETE", path + "&dryRun=true", null)));
            }
            JsonNode answer = api.send("DELETE", path, null);
            control.answered(
                    answer,
                    "deleted: domain %s; missions deleted: %s%s; fields ended: %s"
                            .formatted(
                                    domain,
                                    counted(answer, "missionCount", "missions"),
                                    answer.path("stopped").isEmpty()
                                            ? ""
                                            : ", of which ran: " + names(answer.path("stopped")),
                                    counted(answer, "fieldCount", "fields")));
        });
    }

    /** @param answer of a dry run */
    static String question(String domain, JsonNode answer) {
        int running = answer.path("stopped").size();
        return "Delete domain %s with %s%s, and end %s?"
                .formatted(
                        domain,
                        Counts.of(answer.path("missionCount").asLong(), "mission"),
                        running == 0 ? "" : ", of which %d %s".formatted(running, running == 1 ? "runs" : "run"),
                        Counts.of(answer.path("fieldCount").asLong(), "field"));
    }

    /** A count, and the names if the answer contains them. */
    private static String counted(JsonNode answer, String count, String member) {
        int all = answer.path(count).asInt();
        int named = answer.path(member).size();
        return all == 0 ? "none" : "%d (%s%s)".formatted(all, names(answer.path(member)), named < all ? ", …" : "");
    }

    private static String names(JsonNode list) {
        StringJoiner names = new StringJoiner(", ");
        list.forEach(name -> names.add(name.asText()));
        return names.toString();
    }
}
