package io.furrow.cli.compare;

import java.time.Instant;
import java.util.Collection;
import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.cli.compare.AnalyticsResult.Average;
import io.furrow.cli.compare.AnalyticsResult.Encounter;
import io.furrow.cli.compare.ResultMatch.Verdict;

/**
 * Writes a comparison as JSON: {@code {same, a, b, encounters, averages, stays}}, where each kind has the number of
 * {@code same} results and the list of {@code differences}; times in ISO 8601, distances in meters.
 */
final class ComparisonJson {
    private ComparisonJson() {}

    static ObjectNode of(Comparison comparison) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("same", comparison.isSame());
        json.set("a", side(comparison.a()));
        json.set("b", side(comparison.b()));
        for (ResultKind kind : ResultKind.values()) {
            ObjectNode one = json.putObject(kind.code()).put("same", comparison.count(kind, Verdict.SAME));
            ArrayNode differences = one.putArray("differences");
            comparison.differences(kind).forEach(match -> differences.add(difference(match)));
        }
        return json;
    }

    private static ObjectNode side(SideResults side) {
        ObjectNode json =
                JsonNodeFactory.instance.objectNode().put("name", side.name()).put("epoch", side.epoch());
        ArrayNode missing = json.putArray("missing");
        side.missing().stream().sorted().map(ResultKind::code).forEach(missing::add);
        return json;
    }

    private static ObjectNode difference(ResultMatch match) {
        ObjectNode json = JsonNodeFactory.instance
                .objectNode()
                .put("verdict", match.verdict().code())
                .put("subject", match.subject().name());
        json.set("a", span(match.a()));
        json.set("b", span(match.b()));
        if (!match.changes().isEmpty()) {
            ArrayNode changes = json.putArray("changes");
            match.changes().forEach(change -> changes.add(change.member()));
        }
        return json;
    }

    private static ObjectNode span(AnalyticsResult span) {
        if (span == null) {
            return null;
        }
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("start", time(span.start()));
        if (!span.isOpen()) {
            json.put("end", time(span.end()));
        }
        if (span instanceof Encounter one) {
            json.put("closest", one.closest());
        } else if (span instanceof Average one) {
            if (!one.isEmpty()) {
                json.put("mean", one.mean());
            }
            texts(json.putArray("suspects"), List.copyOf(one.suspects()));
            json.put("quality", one.quality());
        }
        return json;
    }

    private static String time(long millis) {
        return Instant.ofEpochMilli(millis).toString();
    }

    private static void texts(ArrayNode json, Collection<String> texts) {
        texts.stream().sorted().forEach(json::add);
    }
}
