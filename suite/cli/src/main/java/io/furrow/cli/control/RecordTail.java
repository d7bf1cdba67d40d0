package io.furrow.cli.control;

import java.io.IOException;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Option;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.control.table.RecordPage;
import io.furrow.model.ngsi.NgsiJson;

/** Prints the newest records of a topic in the order of their times, and with {@code --follow} those that are written afterwards. */
final class RecordTail {
    private static final int MAX_LISTED = 1000;
    /** Elements of a page with values. */
    private static final int PAGE = 100;

    private final long pollMillis;

    @Option(
            names = {"-n", "--limit"},
            paramLabel = "N",
            defaultValue = "20",
            description = "How many of the newest records, 1 to 1000. Default: ${DEFAULT-VALUE}.")
    private int limit;

    @Option(
            names = {"-f", "--follow"},
            description = "Go on with the records that are written, until Ctrl-C.")
    private boolean follow;

    private final Map<Integer, Long> offsets = new HashMap<>();

    RecordTail() {
        this(1_000);
    }

    /** @param pollMillis time between two requests */
    RecordTail(long pollMillis) {
        this.pollMillis = pollMillis;
    }

    /**
     * Prints them.
     *
     * @param key of the records; null for all
     * @param line prints one for people
     */
    int print(ControlOptions control, String topic, String key, Function<JsonNode, String> line) {
        ListLimit.check(control, limit, MAX_LISTED);
        return control.run(api -> {
            offsets.clear();
            if (follow) {
                unknown(api.list(path(topic, null, PAGE), PAGE).elements(), null);
            }
            ArrayNode newest =
                    api.list(path(topic, key, Math.min(limit, PAGE)), limit).elements();
            unknown(newest, null);
            print(control, reversed(newest), line);
            while (follow && ReplayWatch.pause(pollMillis)) {
                follow(control, api, topic, key, line);
            }
        });
    }

    /** Reads all keys: to find the newest records of one, a request would read far back each time. */
    private void follow(
            ControlOptions control, ControlApi api, String topic, String key, Function<JsonNode, String> line)
            throws IOException {
        ControlApi.Page page = api.list(path(topic, null, PAGE), MAX_LISTED, record -> !isNew(record));
        boolean leftOut = page.hasMore() && page.elements().valueStream().allMatch(this::isNew);
        print(control, unknown(page.elements(), key), line);
        if (leftOut) {
            control.warn("Records are written faster than they are read; some are left out.");
        }
    }

    private static String path(String topic, String key, int limit) {
        Map<String, Object> query = new LinkedHashMap<>();
        query.put("values", true);
        query.put("limit", limit);
        query.put("key", key);
        return TopicCommandGroup.records(topic) + ControlApi.query(query);
    }

    private boolean isNew(JsonNode record) {
        return record.path("offset").asLong()
                > offsets.getOrDefault(record.path("partition").asInt(), -1L);
    }

    /** Remembers records, and returns those that are new and have a key, the oldest first. @param key null for any */
    private ArrayNode unknown(ArrayNode newestFirst, String key) {
        ArrayNode unknown = NgsiJson.array();
        for (JsonNode record : reversed(newestFirst)) {
            if (isNew(record)) {
                offsets.put(
                        record.path("partition").asInt(), record.path("offset").asLong());
                if (key == null || key.equals(record.path("key").asText())) {
                    unknown.add(record);
                }
            }
        }
        return unknown;
    }

    private static ArrayNode reversed(ArrayNode records) {
        ArrayNode reversed = NgsiJson.array();
        records.forEach(record -> reversed.insert(0, record));
        return reversed;
    }

    private void print(ControlOptions control, ArrayNode records, Function<JsonNode, String> line) throws IOException {
        if (!records.isEmpty()) {
            control.print(records, all -> lines(all, line), all -> lines(all, RecordPage::place));
        } else if (!follow) {
            control.remark("There are no such records.");
        }
        control.out().flush();
    }

    private static List<String> lines(JsonNode records, Function<JsonNode, String> line) {
        return records.valueStream().map(line).toList();
    }
}
