package io.furrow.cli.control.table;

import java.util.ArrayList;
import java.util.List;
import java.util.StringJoiner;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;
import io.furrow.model.text.Counts;

/** Prints dead letters: two lines for each in a list, because topics and messages are long. */
public final class DeadLetterTable {
    private DeadLetterTable() {}

    /** A line with place, time, reason and stage, and one with the message, for each letter. */
    public static List<String> lines(JsonNode letters) {
        if (letters.isEmpty()) {
            return List.of("There are no such dead letters.");
        }
        List<String> lines = new ArrayList<>();
        for (JsonNode letter : letters) {
            lines.add("%s  %s  %s  %s"
                    .formatted(
                            RecordPage.place(letter),
                            Times.of(letter.path("time")),
                            RecordPage.text(letter.path("reason")),
                            RecordPage.text(letter.path("stage"))));
            lines.add("  " + RecordPage.text(letter.path("message")));
        }
        return lines;
    }

    /** The place of each letter, as show takes it. */
    public static List<String> names(JsonNode letters) {
        List<String> names = new ArrayList<>();
        letters.forEach(letter -> names.add(RecordPage.place(letter)));
        return names;
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
