package io.furrow.cli.control;

import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.TextNode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.RecordPage;
import io.furrow.cli.time.TimeRangeOptions;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.TopicRules;
import io.furrow.model.topic.Topics;

/** Finds records of topics by what their values contain. */
final class RecordSearch {
    /** How many records of a topic are read at most, where the command selects among them. */
    private static final int MAX_SELECTED = 1000;
    /** Elements of a page with values. */
    private static final int PAGE = 100;

    private static final ControlTable TABLE = new ControlTable("There are no such records.")
            .text("RECORD", record -> TextNode.valueOf(RecordPage.place(record)))
            .time("TIME", "/time")
            .text("KEY", "/key")
            .text("SIZE", "/size");

    @Option(names = "--device", paramLabel = "ID", description = "Id of an entity that the value contains.")
    private String device;

    @Option(names = "--attribute", paramLabel = "NAME", description = "Only records with this attribute.")
    private String attribute;

    @Option(names = "--text", paramLabel = "TEXT", description = "A text that the value contains.")
    private String text;

    @Mixin
    private TimeRangeOptions range;

    @Option(
            names = {"-n", "--limit"},
            paramLabel = "N",
            defaultValue = "20",
            description = "How many of each topic, 1 to 1000. Default: ${DEFAULT-VALUE}.")
    private int limit;

    /** @param topics null for the data topics that are not of replays */
    int print(ControlOptions control, List<String> topics) {
        if (device == null && text == null) {
            throw control.refused("Name a device with --device, or a text with --text.");
        }
        ListLimit.check(control, limit, MAX_SELECTED);
        boolean selects = attribute != null || device != null && text != null;
        Map<String, Object> query = new LinkedHashMap<>();
        query.put("values", selects ? true : null);
        query.put("limit", selects ? PAGE : limit);
        query.put("text", device == null ? text : device);
        range.addTo(query, Duration.ofHours(1));
        return control.run(api -> {
            ArrayNode found = NgsiJson.array();
            boolean more = false;
            for (String topic : topics == null ? dataTopics(api) : topics) {
                String path = TopicCommandGroup.records(topic) + ControlApi.query(query);
                ControlApi.Page page = api.list(path, selects ? MAX_SELECTED : limit);
                List<JsonNode> selected =
                        page.elements().valueStream().filter(this::isSelected).toList();
                found.addAll(selected.subList(0, Math.min(limit, selected.size())));
                more |= page.hasMore() || selected.size() > limit;
            }
            control.print(found, TABLE);
            if (more) {
                control.remark("There may be more; --limit and --since show others.");
            }
        });
    }

    /** The control plane has looked for the first text. */
    private boolean isSelected(JsonNode record) {
        JsonNode value = record.path("value");
        return (attribute == null || value.has(attribute))
                && (device == null || text == null || value.toString().contains(text));
    }

    private static List<String> dataTopics(ControlApi api) {
        List<String> topics = new ArrayList<>();
        ControlTable.rows(api.get(TopicCommandGroup.TOPICS)).forEach(each -> {
            String topic = each.path("topic").asText();
            if (topic.startsWith("data.") && !Topics.isOfReplay(topic) && TopicRules.DEFAULT.mayRead(topic)) {
                topics.add(topic);
            }
        });
        return topics;
    }
}
