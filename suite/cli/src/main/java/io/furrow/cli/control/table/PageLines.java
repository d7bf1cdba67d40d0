package io.furrow.cli.control.table;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;

/** Lines {@code label: value} of a page. */
final class PageLines {
    private static final int WIDTH = 16;

    private final Instant now;
    private final List<String> lines = new ArrayList<>();

    PageLines(Instant now) {
        this.now = now;
    }

    void add(String label, String value) {
        lines.add(("%-" + WIDTH + "s%s").formatted(label + ":", ControlTable.printable(value)));
    }

    List<String> all() {
        return lines;
    }

    /** A time with its distance from now. */
    String ago(JsonNode time) {
        return Times.ago(time.longValue(), now);
    }

    static String reason(JsonNode reason) {
        return reason.isTextual() ? ": " + reason.textValue() : "";
    }
}
