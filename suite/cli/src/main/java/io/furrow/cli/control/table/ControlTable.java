package io.furrow.cli.control.table;

import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;
import java.util.stream.Stream;

import com.fasterxml.jackson.core.JsonPointer;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.MissingNode;

import io.furrow.cli.time.Times;

/** Prints objects as a table, each column as wide as its widest cell. */
public final class ControlTable {
    private final String nothing;
    private final Clock clock;
    private final List<Column> columns = new ArrayList<>();

    private enum Kind {
        TEXT,
        TIME,
        AGE,
        COUNT
    }

    private record Column(String title, Function<JsonNode, JsonNode> value, Kind kind) {}

    /** @param nothing the text without rows */
    public ControlTable(String nothing) {
        this(nothing, Clock.systemUTC());
    }

    /** @param clock for ages */
    ControlTable(String nothing, Clock clock) {
        this.nothing = nothing;
        this.clock = clock;
    }

    /** @param places JSON pointers; the first that resolves is shown */
    public ControlTable text(String title, String... places) {
        return column(title, Kind.TEXT, places);
    }

    /** @param value of the object */
    public ControlTable text(String title, Function<JsonNode, JsonNode> value) {
        columns.add(new Column(title, value, Kind.TEXT));
        return this;
    }

    /** A time, epoch ms or ISO 8601, shown as {@link Times} does. */
    public ControlTable time(String title, String... places) {
        return column(title, Kind.TIME, places);
    }

    /** Age of a time, epoch ms, in its greatest unit: {@code 42s}, {@code 5m}, {@code 3h}, {@code 12d}. */
    public ControlTable age(String title, String... places) {
        return column(title, Kind.AGE, places);
    }

    /** The number of members of a list or an object. */
    public ControlTable count(String title, String... places) {
        return column(title, Kind.COUNT, places);
    }

    private ControlTable column(String title, Kind kind, String... places) {
        List<JsonPointer> pointers = Stream.of(places).map(JsonPointer::compile).toList();
        columns.add(new Column(title, row -> first(pointers, row), kind));
        return this;
    }

    /** Title and one line per object. */
    public List<String> lines(JsonNode rows) {
        if (rows.isEmpty()) {
            return List.of(nothing);
        }
        List<List<String>> cells = new ArrayList<>();
        cells.add(columns.stream().map(Column::title).toList());
        rows.forEach(row -> cells.add(cells(row)));
        int[] widths = widths(cells);
        return cells.stream().map(line -> line(line, widths)).toList();
    }

    /** One line for each of some objects, each column as wide as for all of them. */
    public List<String> lines(JsonNode some, JsonNode all) {
        List<List<String>> cells = new ArrayList<>();
        cells.add(columns.stream().map(Column::title).toList());
        all.forEach(row -> cells.add(cells(row)));
        int[] widths = widths(cells);
        return some.valueStream().map(row -> line(cells(row), widths)).toList();
    }

    /** What a table shows of an object, except ages, which change by themselves. */
    public List<String> content(JsonNode row) {
        return columns.stream()
                .filter(column -> column.kind() != Kind.AGE)
                .map(column -> cell(column, row))
                .toList();
    }

    private List<String> cells(JsonNode row) {
        return columns.stream().map(column -> cell(column, row)).toList();
    }

    private int[] widths(List<List<String>> cells) {
        int[] widths = new int[columns.size()];
        for (List<String> line : cells) {
            for (int i = 0; i < widths.length; i++) {
                widths[i] = Math.max(widths[i], line.get(i).length());
            }
        }
        return widths;
    }

    /** The first cell of each object. */
    public List<String> names(JsonNode rows) {
        List<String> names = new ArrayList<>();
        rows.forEach(row -> names.add(cell(columns.get(0), row)));
        return names;
    }

    private static String line(List<String> cells, int[] widths) {
        StringBuilder line = new StringBuilder();
        for (int i = 0; i < widths.length; i++) {
            line.append(cells.get(i)).append(" ".repeat(widths[i] - cells.get(i).length() + 2));
        }
        return line.toString().stripTrailing();
    }

    private String cell(Column column, JsonNode row) {
        JsonNode value = column.value().apply(row);
        return value.isMissingNode() || value.isNull() ? "-" : cell(column.kind(), value);
    }

    private static JsonNode first(List<JsonPointer> places, JsonNode row) {
        return places.stream()
                .map(row::at)
                .filter(value -> !value.isMissingNode() && !value.isNull())
                .findFirst()
                .orElse(MissingNode.getInstance());
    }

    private String cell(Kind kind, JsonNode value) {
        return switch (kind) {
            case COUNT -> Integer.toString(value.size());
            case TIME -> printable(Times.of(value));
            case AGE -> Times.age(Duration.ofMillis(clock.millis() - value.asLong()));
            case TEXT -> printable(textOf(value));
        };
    }

    /** Returns the list that an answer is or has as its only member, or its features, or a list of the answer. */
    public static JsonNode rows(JsonNode answer) {
        if (answer.isArray()) {
            return answer;
        }
        if (answer.path("features").isArray()) {
            return answer.path("features");
        }
        JsonNode first = answer.iterator().hasNext() ? answer.iterator().next() : answer;
        return answer.size() == 1 && first.isArray()
                ? first
                : JsonNodeFactory.instance.arrayNode().add(answer);
    }

    /** Returns a value without quotes, an object or a list as JSON. */
    public static String textOf(JsonNode value) {
        return value.isValueNode() ? value.asText() : value.toString();
    }

    /** One line, without control characters. */
    public static String printable(String text) {
        return text.replaceAll("\\p{Cc}", " "); // some terminals obey those from U+0080 to U+009F too
    }
}
