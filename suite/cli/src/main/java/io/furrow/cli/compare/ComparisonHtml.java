package io.furrow.cli.compare;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.TreeMap;
import java.util.function.Predicate;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.cli.compare.AnalyticsResult.Average;
import io.furrow.cli.compare.ResultMatch.Verdict;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Writes a comparison as one self-contained HTML file, with uPlot and the data. Each pair, device and field has a row of A above one of
 * B, averages have two curves. Rows with differences come first in each kind; rows beyond {@value #MAX_ROWS} are left out.
 */
final class ComparisonHtml {
    static final int MAX_ROWS = 40;

    private static final String LIBRARY = "META-INF/resources/webjars/uplot/%s/%s";

    private final Comparison comparison;
    private long first = Long.MAX_VALUE;
    private long last = Long.MIN_VALUE;

    private ComparisonHtml(Comparison comparison) {
        this.comparison = comparison;
    }

    static String of(Comparison comparison) throws IOException {
        Properties library = new Properties();
        library.load(open("META-INF/maven/org.webjars.npm/uplot/pom.properties"));
        String version = library.getProperty("version");
        Map<String, String> parts = new LinkedHashMap<>();
        parts.put("uplot.licence", text(LIBRARY.formatted(version, "LICENSE")));
        parts.put("uplot.css", text(LIBRARY.formatted(version, "dist/uPlot.min.css")));
        parts.put("uplot.js", text(LIBRARY.formatted(version, "dist/uPlot.iife.min.js")));
        parts.put("data", new ComparisonHtml(comparison).data());
        String html = text("io/furrow/cli/compare/comparison.html");
        for (Map.Entry<String, String> part : parts.entrySet()) {
            html = html.replace("{{" + part.getKey() + "}}", part.getValue());
        }
        return html;
    }

    private static String text(String resource) throws IOException {
        try (InputStream stream = open(resource)) {
            return new String(stream.readAllBytes(), StandardCharsets.UTF_8);
        }
    }

    private static InputStream open(String resource) {
        InputStream stream = ComparisonHtml.class.getClassLoader().getResourceAsStream(resource);
        if (stream == null) {
            throw new IllegalStateException(resource + " is not on the class path: Furrow was not built as a whole");
        }
        return stream;
    }

    /** Escaped, so that no name can end an element of the page. */
    private String data() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("a", comparison.a().name()).put("b", comparison.b().name()).put("same", comparison.isSame());
        ArrayNode kinds = json.putArray("kinds");
        for (ResultKind kind : ResultKind.values()) {
            if (!comparison.matches().get(kind).isEmpty()) {
                kinds.add(kind(kind));
            }
        }
        json.put("from", first).put("to", Math.max(last, first + 1));
        return new String(NgsiJson.write(json), StandardCharsets.UTF_8).replace("<", "\\u003c");
    }

    private ObjectNode kind(ResultKind kind) {
        Map<ResultSubject, List<ResultMatch>> bySubject = new TreeMap<>();
        comparison
                .matches()
                .get(kind)
                .forEach(match -> bySubject
                        .computeIfAbsent(match.subject(), none -> new ArrayList<>())
                        .add(match));
        Predicate<Map.Entry<ResultSubject, List<ResultMatch>>> differs =
                row -> row.getValue().stream().anyMatch(match -> match.verdict() != Verdict.SAME);
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("name", kind.code());
        json.put("curves", kind == ResultKind.AVERAGES).put("more", Math.max(0, bySubject.size() - MAX_ROWS));
        for (Verdict verdict : Verdict.values()) {
            json.withObject("/counts").put(verdict.code(), comparison.count(kind, verdict));
        }
        ArrayNode rows = json.putArray("lanes");
        Stream.concat(
                        bySubject.entrySet().stream().filter(differs),
                        bySubject.entrySet().stream().filter(differs.negate()))
                .limit(MAX_ROWS)
                .forEach(row -> {
                    ObjectNode one = rows.addObject().put("name", row.getKey().name());
                    ArrayNode matches = one.putArray("matches");
                    row.getValue().forEach(match -> matches.add(match(match)));
                });
        return json;
    }

    private ObjectNode match(ResultMatch match) {
        ObjectNode json = JsonNodeFactory.instance
                .objectNode()
                .put("verdict", match.verdict().code())
                .put("text", ComparisonText.match(match));
        json.set("a", span(match.a()));
        json.set("b", span(match.b()));
        return json;
    }

    /** Times in epoch ms; an open one has no end. */
    private ObjectNode span(AnalyticsResult span) {
        if (span == null) {
            return null;
        }
        long start = comparison.range().start(span);
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("start", start);
        first = Math.min(first, start);
        last = Math.max(last, start);
        if (!span.isOpen()) {
            long end = comparison.range().end(span);
            json.put("end", end);
            last = Math.max(last, end);
        }
        if (span instanceof Average average && !average.isEmpty()) {
            json.put("mean", average.mean());
        }
        return json;
    }
}
