package io.furrow.bench.frame;

import java.io.PrintWriter;
import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.function.Function;
import java.util.function.ToDoubleFunction;
import java.util.stream.Collectors;
import java.util.stream.DoubleStream;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** A table of figures: texts and numbers by column name. It is printed, written as JSON, or drawn. */
public final class Figures {
    private final String title;
    private final Set<String> names = new LinkedHashSet<>();
    private final List<Map<String, Object>> rows = new ArrayList<>();

    /** @param title printed above the table; may be empty */
    public Figures(String title) {
        this.title = title;
    }

    /** Adds a row. @param namesAndValues alternating; a row may lack some */
    public Figures add(Object... namesAndValues) {
        Map<String, Object> row = new LinkedHashMap<>();
        for (int i = 0; i < namesAndValues.length; i += 2) {
            row.put((String) namesAndValues[i], namesAndValues[i + 1]);
        }
        names.addAll(row.keySet());
        rows.add(row);
        return this;
    }

    /** For an even number, the upper one; NaN without values. */
    public static double median(DoubleStream values) {
        double[] sorted = values.sorted().toArray();
        return sorted.length == 0 ? Double.NaN : sorted[sorted.length / 2];
    }

    public static <T> double median(Collection<T> runs, ToDoubleFunction<T> figure) {
        return median(runs.stream().mapToDouble(figure));
    }

    /** Texts to the left, numbers to the right. */
    public void print(PrintWriter out) {
        if (!title.isEmpty()) {
            out.println(title);
        }
        List<StringBuilder> lines = IntStream.rangeClosed(0, rows.size())
                .mapToObj(i -> new StringBuilder())
                .toList();
        names.forEach(name -> append(name, lines));
        lines.forEach(line -> out.println(line.toString().stripTrailing()));
        out.println();
        out.flush();
    }

    private void append(String name, List<StringBuilder> lines) {
        List<String> cells = new ArrayList<>(List.of(name));
        rows.forEach(row -> cells.add(text(row.get(name))));
        boolean isText = rows.stream().map(row -> row.get(name)).allMatch(String.class::isInstance);
        int width = cells.stream().mapToInt(String::length).max().orElse(0);
        for (int i = 0; i < cells.size(); i++) {
            String gap = " ".repeat(width - cells.get(i).length());
            lines.get(i).append(lines.get(i).isEmpty() ? "" : "  ");
            lines.get(i).append(isText ? cells.get(i) + gap : gap + cells.get(i));
        }
    }

    private static String text(Object value) {
        if (value instanceof Double real) {
            return String.format(Locale.ROOT, Math.abs(real) >= 100 ? "%.0f" : "%.2f", real);
        }
        return value == null ? "" : value.toString();
    }

    /** Without the title. */
    public String markdown() {
        return "| " + String.join(" | ", names) + " |\n" + "|---".repeat(names.size()) + "|\n"
                + cells(row -> "| " + String.join(" | ", row) + " |\n");
    }

    /** Without the title. */
    public String html() {
        return "<table><tr><th>" + String.join("</th><th>", names) + "</th></tr>\n"
                + cells(row -> "<tr><td>" + escaped(String.join("\0", row)).replace("\0", "</td><td>") + "</td></tr>\n")
                + "</table>\n";
    }

    private String cells(Function<List<String>, String> line) {
        return rows.stream()
                .map(row -> line.apply(
                        names.stream().map(row::get).map(Figures::text).toList()))
                .collect(Collectors.joining());
    }

    public static String escaped(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;");
    }

    public String title() {
        return title;
    }

    /** An object for each row. */
    public ArrayNode json() {
        ArrayNode json = JsonNodeFactory.instance.arrayNode();
        for (Map<String, Object> row : rows) {
            ObjectNode object = json.addObject();
            row.forEach(object::putPOJO);
        }
        return json;
    }

    /** Draws columns over another one, on logarithmic axes, with a line for each value of a third. */
    public Chart chart(String x, List<String> columns, String lines) {
        Chart chart = new Chart(title, x, "").logarithmic();
        for (String y : columns) {
            rows.stream().map(row -> row.get(lines)).distinct().forEach(value -> {
                List<Map<String, Object>> those = rows.stream()
                        .filter(row -> value.equals(row.get(lines)) && number(row, x) > 0 && number(row, y) > 0)
                        .toList();
                chart.line("%s, %s %s".formatted(y, value, lines), those, row -> number(row, x), row -> number(row, y));
            });
        }
        return chart;
    }

    private static double number(Map<String, Object> row, String name) {
        return ((Number) row.get(name)).doubleValue();
    }
}
