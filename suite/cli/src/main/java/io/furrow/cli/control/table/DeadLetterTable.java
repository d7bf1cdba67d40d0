package io.furrow.cli.control.table;

import java.io.UncheckedIOException;
import java.util.ArrayList;
import java.util.List;
import java.util.StringJoiner;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.Counts;

/** Prints dead letters: two lines for each in a list, because topics and messages are long, and a page for one. */
public final class DeadLetterTable {
    private static final List<String> MEMBERS = List.of("reason", "stage", "message", "source", "key", "size");

    private DeadLetterTable() {}

    /** A line with place, time, reason and stage, and one with the message, for each letter. */
    public static List<String> lines(JsonNode letters) {
        if (letters.isEmpty()) {
            return List.of("There are no such dead letters.");
        }
        List<String> lines = new ArrayList<>();
        for (JsonNode letter : letters) {
            lines.add("%s  %s  %s  %s"
                    .formatted(place(letter), time(letter), text(letter, "reason"), text(letter, "stage")));
            lines.add("  " + text(letter, "message"));
        }
        return lines;
    }

    /** The place of each letter, as show takes it. */
    public static List<String> names(JsonNode letters) {
        List<String> names = new ArrayList<>();
        letters.forEach(letter -> names.add(place(letter)));
        return names;
    }

    private static String place(JsonNode letter) {
        return "%s-%s@%s"
                .formatted(
                        letter.path("topic").asText(),
                        letter.path("partition").asText(),
                        letter.path("offset").asText());
    }

    private static String time(JsonNode letter) {
        return Times.of(letter.path("time").asLong());
    }

    private static String text(JsonNode letter, String member) {
        JsonNode value = letter.path(member);
        return value.isMissingNode() || value.isNull() ? "-" : ControlTable.printable(ControlTable.textOf(value));
    }

    /** A letter with its headers and its value. */
    public static List<String> page(JsonNode letter) {
        List<String> lines = new ArrayList<>();
        lines.add("letter   " + place(letter));
        lines.add("time     " + time(letter));
        MEMBERS.forEach(member -> lines.add("%-8s %s".formatted(member, text(letter, member))));
        lines.add("headers");
        letter.path("headers")
                .properties()
                .forEach(header -> lines.add("  %s: %s"
                        .formatted(
                                ControlTable.printable(header.getKey()),
                                ControlTable.printable(header.getValue().asText()))));
        if (letter.has("value")) {
            lines.add("value, as " + letter.path("encoding").asText()
                    + (letter.path("cut").asBoolean() ? ", the beginning only" : ""));
            lines.addAll(value(letter.path("value")));
        }
        return lines;
    }

    private static List<String> value(JsonNode value) {
        try {
            String text = value.isContainerNode()
                    ? NgsiJson.mapper().writerWithDefaultPrettyPrinter().writeValueAsString(value)
                    : value.asText();
            return text.lines().map(ControlTable::printable).toList();
        } catch (JsonProcessingException e) { // it was read from JSON
            throw new UncheckedIOException(e);
        }
    }

    /** Sentences about what a redrive has sent and left. */
    public static String redriven(JsonNode answer) {
        StringJoiner sent = new StringJoiner(", ", ": ", "").setEmptyValue("");
        answer.path("reasons")
                .properties()
                .forEach(each -> sent.add(each.getValue().asText() + " " + each.getKey()));
        StringJoiner lines = new StringJoiner(System.lineSeparator());
        lines.add("%s %s from %s to %s%s"
                .formatted(
                        answer.path("dryRun").asBoolean() ? "would send" : "sent",
                        Counts.of(answer.path("count").asLong(), "dead letter"),
                        answer.path("topic").asText(),
                        answer.path("to").asText(),
                        sent));
        answer.path("left")
                .forEach(each -> lines.add("left where they are: %s %s"
                        .formatted(each.path("count").asText(), each.path("why").asText())));
        if (!answer.path("complete").asBoolean(true)) {
            lines.add("There are more than one request reads; repeat the command for the others.");
        }
        return lines.toString();
    }
}
