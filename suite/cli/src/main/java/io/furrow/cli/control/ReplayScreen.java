package io.furrow.cli.control;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.TextNode;

import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.time.Times;
import io.furrow.model.text.Counts;

/** Formats a replay as lines of text, none wider than the terminal. */
final class ReplayScreen {
    private static final int WIDEST_BAR = 60;
    private static final List<String> OVER = List.of("ended", "stopped", "failed");
    private static final String HELP =
            "space pause  ←/→ 10 s  [/] 1 min  ./, step  +/- speed  l loop  m marker  q quit";

    private ReplayScreen() {}

    /**
     * The block that is redrawn, always of the same height.
     *
     * @param notice the text being typed, or an error; may be empty
     */
    static List<String> block(JsonNode replay, String notice, boolean help, int width) {
        JsonNode progress = replay.at("/status/progress");
        List<String> lines = new ArrayList<>();
        lines.add("%s  %s".formatted(replay.path("replay").asText(), state(replay)));
        lines.add(bar(replay, width));
        lines.add(times(replay));
        lines.add(counts(progress));
        lines.add(reason(replay));
        lines.add(notice.isEmpty() ? help ? HELP : "? help" : notice);
        return lines.stream().map(line -> cut(line, width)).toList();
    }

    /** A single line, for output without a terminal. */
    static String line(JsonNode replay) {
        JsonNode progress = replay.at("/status/progress");
        String reason = reason(replay);
        return ControlTable.printable("%s  %s  %s  %s%s"
                .formatted(
                        replay.path("replay").asText(),
                        state(replay),
                        times(replay),
                        counts(progress),
                        reason.isEmpty() ? "" : "  " + reason));
    }

    /** The actual state, and the desired one if it differs. */
    static JsonNode listed(JsonNode replay) {
        String state = replay.at("/status/state").asText("not begun");
        String desired = replay.path("wanted").asText(state);
        boolean settled =
                state.equals(desired) || OVER.contains(state) || state.equals("not begun") && desired.equals("running");
        return TextNode.valueOf(settled ? state : "%s, %s is requested".formatted(state, desired));
    }

    private static String state(JsonNode replay) {
        String state = replay.at("/status/state").asText(replay.path("wanted").asText("?"));
        JsonNode speed = replay.path("speed");
        String range = replay.hasNonNull("range")
                ? "  loops from %s to %s"
                        .formatted(
                                Times.of(replay.at("/range/from").asLong()),
                                Times.of(replay.at("/range/to").asLong()))
                : "";
        String atSpeed = speed.isMissingNode() // of a replay that the manager has deleted
                ? ""
                : "  speed " + (speed.isNumber() ? number(speed.asDouble()) : speed.asText());
        return "%s%s  epoch %d%s"
                .formatted(state, atSpeed, replay.at("/status/progress/epoch").asLong(), range);
    }

    /** Progress of the played range; full at the end, even after a final gap. */
    private static String bar(JsonNode replay, int width) {
        int cells = Math.max(4, Math.min(WIDEST_BAR, width - 9));
        boolean ended = replay.at("/status/state").asText().equals("ended");
        double share = ended
                ? 1
                : PlayedRange.of(replay)
                        .share(replay.at("/status/progress/position").asLong());
        int full = (int) Math.round(cells * share);
        return "[%s%s] %3.0f %%".formatted("#".repeat(full), "·".repeat(cells - full), 100 * share);
    }

    private static String times(JsonNode replay) {
        JsonNode progress = replay.at("/status/progress");
        if (!progress.has("position")) {
            return "not begun";
        }
        PlayedRange part = PlayedRange.of(replay);
        long position = progress.path("position").asLong();
        return "%s  %s / %s"
                .formatted(Times.of(position), clock(position - part.from()), clock(part.to() - part.from()));
    }

    private static String counts(JsonNode progress) {
        long slip = progress.path("slip").asLong();
        return String.format(
                Locale.ROOT,
                "%.1f events/s  late %d ms%s  %s",
                progress.path("rate").asDouble(),
                progress.path("lateness").asLong(),
                slip == 0 ? "" : "  slipped " + slip + " ms",
                Counts.of(progress.path("events").asLong(), "event"));
    }

    private static String reason(JsonNode replay) {
        String waiting = replay.at("/status/progress/waiting").asText("");
        return waiting.isEmpty() ? replay.at("/status/reason").asText("") : "waits: " + waiting;
    }

    private static String clock(long millis) {
        Duration duration = Duration.ofMillis(Math.max(0, millis));
        return "%d:%02d:%02d".formatted(duration.toHours(), duration.toMinutesPart(), duration.toSecondsPart());
    }

    private static String number(double value) {
        return String.format(Locale.ROOT, "%.2f", value).replaceFirst("\\.?0+$", "");
    }

    private static String cut(String line, int width) {
        return line.length() <= width ? line : line.substring(0, Math.max(0, width - 1)) + "…";
    }
}
