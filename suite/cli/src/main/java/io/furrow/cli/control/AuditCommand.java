package io.furrow.cli.control;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.TextNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.control.table.AnswerText;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.option.HelpOption;
import io.furrow.cli.time.TimeRangeOptions;
import io.furrow.cli.time.Times;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow audit}. */
@Command(
        name = "audit",
        abbreviateSynopsis = true,
        description = "Lists commands and what became of them, the newest first: who requested which, and when.")
public final class AuditCommand implements Callable<Integer> {
    private static final int MAX_LISTED = 1000;
    private static final ControlTable TABLE = new ControlTable("There are no such commands.")
            .time("TIME", "/time")
            .text("USER", "/user")
            .text("TARGET", "/target")
            .text("COMMAND", "/command")
            .text("RESULT", "/result")
            .text("ABOUT", entry -> TextNode.valueOf(AnswerText.sentence(entry.path("about"))))
            .text("REASON", "/reason");

    @Mixin
    private ControlOptions control;

    @Option(names = "--mission", paramLabel = "NAME", description = "Only those about this mission.")
    private String mission;

    @Option(names = "--device", paramLabel = "ID", description = "Only those about this device.")
    private String device;

    @Option(
            names = "--user",
            paramLabel = "NAME",
            description = "Of the commands that are read, only those of this user.")
    private String user;

    @Mixin
    private TimeRangeOptions range;

    @Option(
            names = {"-n", "--limit"},
            paramLabel = "N",
            defaultValue = "50",
            description = "How many to read at most, 1 to 1000. Default: ${DEFAULT-VALUE}.")
    private int limit;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() {
        ListLimit.check(control, limit, MAX_LISTED);
        return control.run(api -> {
            Map<String, Object> query = new LinkedHashMap<>();
            query.put("limit", limit);
            query.put("mission", mission);
            query.put("device", device);
            ControlApi.Page read = api.list("/api/audit" + ControlApi.query(query), limit);
            ArrayNode shown = NgsiJson.array();
            read.elements().forEach(entry -> {
                if (range.contains(Times.instant(entry.path("time")))
                        && (user == null || user.equals(entry.path("user").asText()))) {
                    shown.add(entry);
                }
            });
            control.print(shown, TABLE);
            JsonNode oldest = read.elements().path(read.elements().size() - 1).path("time");
            if (read.hasMore() && (oldest.isMissingNode() || !range.beginsAfter(Times.instant(oldest)))) {
                control.remark("There may be more; --limit reads more of them.");
            }
        });
    }
}
