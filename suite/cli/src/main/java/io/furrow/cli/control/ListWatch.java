package io.furrow.cli.control;

import java.io.IOException;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Option;

import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.model.ngsi.NgsiJson;

/** The option {@code --watch} of lists: after a list, it prints each row that is new or has changed. */
class ListWatch {
    private final long pollMillis;

    @Option(
            names = {"-w", "--watch"},
            description = "Then print each row that is new or has changed, every 2 s, until Ctrl-C.")
    private boolean watch;

    ListWatch() {
        this(2_000);
    }

    /** @param pollMillis time between two requests */
    ListWatch(long pollMillis) {
        this.pollMillis = pollMillis;
    }

    /** Prints the changes of a list; returns at once without the option. @param listed is printed already */
    void follow(ControlOptions control, JsonNode listed, Supplier<JsonNode> list, ControlTable table)
            throws IOException {
        Map<String, List<String>> shown = new HashMap<>();
        changed(ControlTable.rows(listed), shown, table);
        control.out().flush();
        while (watch && ReplayWatch.pause(pollMillis)) {
            JsonNode rows = ControlTable.rows(list.get());
            ArrayNode changed = changed(rows, shown, table);
            if (!changed.isEmpty()) {
                control.print(changed, some -> table.lines(some, rows), table::names);
                control.out().flush();
            }
        }
    }

    /** Returns the rows that are not shown as they are, and remembers them. */
    private static ArrayNode changed(JsonNode rows, Map<String, List<String>> shown, ControlTable table) {
        ArrayNode changed = NgsiJson.array();
        Map<String, List<String>> now = new HashMap<>();
        rows.forEach(row -> {
            List<String> content = table.content(row);
            now.put(content.get(0), content);
            if (!content.equals(shown.get(content.get(0)))) {
                changed.add(row);
            }
        });
        shown.clear();
        shown.putAll(now);
        return changed;
    }
}
