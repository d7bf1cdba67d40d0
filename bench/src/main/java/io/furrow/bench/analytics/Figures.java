package io.furrow.bench.analytics;

import java.io.PrintWriter;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** A table of figures: texts and numbers under names that all rows share. */
public final class Figures {
    private final String title;
    private final List<Map<String, Object>> rows = new ArrayList<>();

    public Figures(String title) {
        this.title = title;
    }

    /** @param namesAndValues in turns */
    public void add(Object... namesAndValues) {
        Map<String, Object> row = new LinkedHashMap<>();
        for (int i = 0; i < namesAndValues.length; i += 2) {
            row.put((String) namesAndValues[i], namesAndValues[i + 1]);
        }
        rows.add(row);
    }

    public void print(PrintWriter out) {
        out.println(title);
        if (!rows.isEmpty()) {
            rows.get(0).keySet().forEach(name -> out.printf("%16s", name));
            out.println();
        }
        for (Map<String, Object> row : rows) {
            row.values().forEach(value -> out.printf("%16s", text(value)));
            out.println();
        }
        out.println();
        out.flush();
    }

    private static String text(Object value) {
        if (!(value instanceof Number number) || value instanceof Integer) {
            return value.toString();
        }
        double real = number.doubleValue();
        return String.format(Locale.ROOT, Math.abs(real) >= 100 ? "%,.0f" : "%.2f", real);
    }

    public ArrayNode json() {
        ArrayNode json = JsonNodeFactory.instance.arrayNode();
        for (Map<String, Object> row : rows) {
            ObjectNode object = json.addObject();
            row.forEach(object::putPOJO);
        }
        return json;
    }

    /** How two columns grow with another: a line each for every value of a third. */
    public String svg(String x, List<String> columns, String lines) {
        Plot plot = new Plot(title, x);
        for (String y : columns) {
            rows.stream()
                    .map(row -> row.get(lines))
                    .distinct()
                    .forEach(value -> plot.line("%s, %s %s".formatted(y, value, lines), points(x, y, lines, value)));
        }
        return plot.svg();
    }

    private List<double[]> points(String x, String y, String where, Object value) {
        return rows.stream()
                .filter(row -> value.equals(row.get(where)))
                .map(row -> new double[] {number(row, x), number(row, y)})
                .filter(point -> point[0] > 0 && point[1] > 0)
                .toList();
    }

    private static double number(Map<String, Object> row, String name) {
        return ((Number) row.get(name)).doubleValue();
    }
}
