package io.furrow.cli.control.table;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;

/** Prints objects by their members, of which it knows the times. */
public final class AnswerText {
    /** Members of answers that are epoch ms. */
    private static final Set<String> TIMES = Set.of(
            "at",
            "changed",
            "created",
            "due",
            "ends",
            "first",
            "from",
            "last",
            "position",
            "shows",
            "since",
            "start",
            "startAt",
            "time",
            "to",
            "until");

    /** Members that every answer has. */
    private static final Set<String> COMMON = Set.of("type", "status", "requestId", "dryRun");

    private static final long MIN_TIME = 100_000_000_000L;

    private AnswerText() {}

    /** The members in one sentence, without those that every answer has. */
    public static String sentence(JsonNode answer) {
        return answer.properties().stream()
                .filter(each -> !COMMON.contains(each.getKey()))
                .map(each -> each.getKey().replace('_', ' ') + " " + text(each, " "))
                .collect(Collectors.joining(", "));
    }

    /** The value of the first of these members, which is a name. */
    public static String name(JsonNode answer) {
        return answer.properties().stream()
                .filter(each -> !COMMON.contains(each.getKey()))
                .findFirst()
                .map(each -> text(each, " "))
                .orElse("");
    }

    /** @param separator of the elements of a list */
    private static String text(Map.Entry<String, JsonNode> member, String separator) {
        JsonNode value = member.getValue();
        if (value.isArray() && value.valueStream().allMatch(JsonNode::isTextual)) {
            String elements = value.valueStream().map(JsonNode::asText).collect(Collectors.joining(separator));
            return elements.isEmpty() ? "-" : ControlTable.printable(elements);
        }
        boolean time = TIMES.contains(member.getKey()) && value.isIntegralNumber() && value.longValue() >= MIN_TIME;
        return time ? Times.of(value) : ControlTable.printable(ControlTable.textOf(value));
    }

    /** A line for each member. */
    public static List<String> members(JsonNode object) {
        Map<String, String> members = new LinkedHashMap<>();
        addMembers("", object, members);
        int width = members.keySet().stream().mapToInt(String::length).max().orElse(0);
        return members.entrySet().stream()
                .map(each -> each.getKey() + " ".repeat(width - each.getKey().length() + 2) + each.getValue())
                .toList();
    }

    /** Adds the members of an object, those of an object in it as {@code a.b}. */
    private static void addMembers(String before, JsonNode object, Map<String, String> members) {
        for (Map.Entry<String, JsonNode> each : object.properties()) {
            if (each.getValue().isObject()) {
                addMembers(before + each.getKey() + ".", each.getValue(), members);
            } else {
                members.put(before + each.getKey(), text(each, ", "));
            }
        }
    }
}
