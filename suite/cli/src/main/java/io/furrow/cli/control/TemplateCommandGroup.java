package io.furrow.cli.control;

import java.nio.file.Files;
import java.nio.file.Path;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.JsonFile;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.option.Confirmation;

/** {@code ./furrow template}. */
@Command(
        name = "template",
        description = "Lists, exports, imports and deletes templates: device lists for new missions.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND")
public final class TemplateCommandGroup extends CommandGroup {
    private static final String TEMPLATES = "/api/templates";
    private static final String NAME = "NAME of the template, its newest version, or NAME@VERSION.";

    @Command(name = "list", description = "Lists all versions of all templates.")
    int list(@Mixin ControlOptions control, @Mixin ListOptions list) {
        return list.show(
                control,
                TEMPLATES,
                new ControlTable("There is no template; ./furrow template import FILE makes one.")
                        .text("TEMPLATE", "/template")
                        .text("VERSION", "/version")
                        .count("GROUPS", "/devices")
                        .text("DESCRIPTION", "/description"));
    }

    @Command(name = "export", description = "Writes a template as JSON that import reads.")
    int export(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "TEMPLATE", description = NAME) String template,
            @Parameters(paramLabel = "FILE", arity = "0..1", description = "Where to. Default: the terminal.")
                    Path file) {
        return control.run(api -> {
            JsonNode json = api.get(TEMPLATES + ControlApi.part(template));
            if (file == null) {
                control.print(json);
                return;
            }
            Files.writeString(file, json.toPrettyString() + System.lineSeparator());
            control.out()
                    .println("exported: template %s@%s to %s"
                            .formatted(
                                    json.path("template").asText(),
                                    json.path("version").asText(),
                                    file));
        });
    }

    @Command(name = "import", description = "Saves a template from a file of JSON as the next version of its name.")
    int importFrom(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "FILE", description = "A file written by export.") Path file) {
        return control.run(api -> control.answered(api.send("POST", TEMPLATES, JsonFile.read(file))));
    }

    @Command(name = "delete", description = "Deletes all versions of a template, or one. Missions keep their devices.")
    int delete(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "TEMPLATE", description = "NAME, for all versions, or NAME@VERSION.")
                    String template,
            @Mixin Confirmation confirmation) {
        confirmation.ask((template.contains("@") ? "Delete template %s?" : "Delete all versions of template %s?")
                .formatted(template));
        return control.command("DELETE", TEMPLATES + ControlApi.part(template), null);
    }
}
