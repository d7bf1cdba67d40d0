package io.furrow.bench.evaluation;

import java.util.List;
import java.util.function.UnaryOperator;
import java.util.stream.Collectors;

/** A table of a report, as Markdown and as HTML. */
record ReportTable(String title, List<String> heads, List<List<String>> rows) {
    String markdown() {
        return "\n## " + title + "\n\n" + line(heads) + "|---".repeat(heads.size()) + "|\n"
                + rows.stream().map(ReportTable::line).collect(Collectors.joining());
    }

    private static String line(List<String> cells) {
        return "| " + String.join(" | ", cells) + " |\n";
    }

    String html() {
        return "<h2>" + title + "</h2>\n<table>" + row(heads, head -> "<th>" + head + "</th>")
                + rows.stream()
                        .map(row -> row(row, cell -> "<td>" + escaped(cell) + "</td>"))
                        .collect(Collectors.joining())
                + "</table>\n";
    }

    private static String row(List<String> cells, UnaryOperator<String> form) {
        return "<tr>" + cells.stream().map(form).collect(Collectors.joining()) + "</tr>\n";
    }

    static String escaped(String text) {
        return text.replace("&", "&amp;").replace("<", "&lt;");
    }
}
