package io.furrow.cli.control;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.control.table.DeadLetterTable;
import io.furrow.cli.control.table.RecordPage;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.time.TimeRangeOptions;

/** {@code ./furrow dead-letters}. */
@Command(
        name = "dead-letters",
        description = "Lists, shows and redrives records that could not be processed.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND")
public final class DeadLetterCommandGroup extends CommandGroup {
    private static final String PATH = "/api/dead-letters";
    private static final int MAX_LISTED = 1000;

    @Command(name = "list", abbreviateSynopsis = true, description = "Lists dead letters, the newest first.")
    int list(
            @Mixin ControlOptions control,
            @Option(
                            names = "--topic",
                            paramLabel = "TOPIC",
                            description = "Only this topic of dead letters, for instance data.raw.dead. Default: all.")
                    String topic,
            @Option(
                            names = "--reason",
                            paramLabel = "CODE",
                            description = "Only those with this reason, for instance not-json.")
                    String reason,
            @Option(
                            names = "--stage",
                            paramLabel = "NAME",
                            description = "Only those of this stage, for instance ngsi-source.")
                    String stage,
            @Mixin TimeRangeOptions range,
            @Option(
                            names = {"-n", "--limit"},
                            paramLabel = "N",
                            defaultValue = "50",
                            description = "How many at most, 1 to 1000. Default: ${DEFAULT-VALUE}.")
                    int limit) {
        ListLimit.check(control, limit, MAX_LISTED);
        Map<String, Object> query = new LinkedHashMap<>();
        query.put("limit", limit);
        query.put("topic", topic);
        query.put("reason", reason);
        query.put("stage", stage);
        range.addTo(query);
        return control.run(api -> {
            ControlApi.Page letters = api.list(PATH + ControlApi.query(query), limit);
            if (!letters.elements().isEmpty() || !letters.hasMore()) {
                control.print(letters.elements(), DeadLetterTable::lines, DeadLetterTable::names);
            }
            if (letters.hasMore()) {
                control.remark("There may be more; --limit, --since and --to show others.");
            }
        });
    }

    @Command(name = "show", description = "Shows a dead letter with its headers and its value.")
    int show(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "LETTER", description = RecordPlace.FORM + "data.raw.dead-0@17.") String letter) {
        return control.showPage(PATH + RecordPlace.of(control, letter).path(""), RecordPage::of);
    }

    @Command(
            name = "redrive",
            abbreviateSynopsis = true,
            description = "Writes dead letters unchanged to the topic that they came from, each once. Use it after the "
                    + "cause has been repaired. Notifications of the NGSI source came from no topic: they are left "
                    + "without --to.")
    int redrive(
            @Mixin ControlOptions control,
            @Option(
                            names = "--topic",
                            paramLabel = "TOPIC",
                            defaultValue = "data.raw.dead",
                            description = "Topic of the dead letters. Default: ${DEFAULT-VALUE}.")
                    String topic,
            @Option(
                            names = "--to",
                            paramLabel = "TOPIC",
                            description =
                                    "Topic to write them to, data.* or ngsi.*, which must exist. Default: that of --topic without "
                                            + "'.dead'. Notifications of the NGSI source can be read from the topic of the "
                                            + "normalize job, ngsi.notifications, where that job runs.")
                    String to,
            @Option(
                            names = "--reason",
                            paramLabel = "CODE,…",
                            split = ",",
                            hideParamSyntax = true,
                            description = "Only those with one of these reasons, for instance not-json. Default: all.")
                    List<String> reasons,
            @Option(
                            names = "--stage",
                            paramLabel = "NAME,…",
                            split = ",",
                            hideParamSyntax = true,
                            description =
                                    "Only those of these stages. Default: all but routes, ingest-images, missions and the "
                                            + "analytics jobs, where the event itself was processed and would become a duplicate.")
                    List<String> stages,
            @Option(names = "--again", description = "Also those that this command has sent back before.")
                    boolean again,
            @Option(names = "--dry-run", description = "Count them, write nothing.") boolean dryRun) {
        Map<String, Object> body = new LinkedHashMap<>();
        body.put("topic", topic);
        body.put("to", to);
        body.put("reasons", reasons);
        body.put("stages", stages);
        body.put("again", again ? true : null);
        return control.run(api -> {
            JsonNode answer =
                    api.send("POST", PATH + "/redrive" + (dryRun ? "?dryRun=true" : ""), ControlOptions.object(body));
            control.answered(answer, DeadLetterTable.redriven(answer));
        });
    }
}
