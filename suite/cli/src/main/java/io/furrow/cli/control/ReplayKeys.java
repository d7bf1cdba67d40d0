package io.furrow.cli.control;

import java.time.Duration;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;

/** Translates keys into requests while a replay is watched; buffers the note or range being typed. */
final class ReplayKeys {
    private static final Set<String> NEEDING_A_POSITION =
            Set.of("left", "right", "[", "]", "shift-left", "shift-right", "l", "m");
    private static final Duration STEP = Duration.ofSeconds(10);
    private static final Duration LEAP = Duration.ofMinutes(1);
    private static final double SLOWEST = 0.1;
    private static final double FASTEST = 1000;

    private StringBuilder note;
    private long noteTime;
    private Long loopFrom;
    private long soughtFrom = -1;
    private long sought;
    private boolean help;
    private String message = "";

    /**
     * A request.
     *
     * @param path relative to the replay, or to the API if it begins with a slash
     */
    record Request(String path, Map<String, Object> body) {}

    /** The text being typed; empty if there is none. */
    Optional<String> note() {
        return Optional.ofNullable(note).map(StringBuilder::toString);
    }

    boolean isHelp() {
        return help;
    }

    /** The response to the last key; may be empty. */
    String message() {
        return message;
    }

    /**
     * @param key a character, or the name of a {@link KeyReader}
     * @param replay as the control plane reports it
     * @return empty if the key needs no request
     */
    Optional<Request> press(String key, JsonNode replay) {
        message = "";
        if (note != null) {
            return type(key, replay);
        }
        if (NEEDING_A_POSITION.contains(key) && replay.at("/status/progress/to").asLong() == 0) {
            message = "It has not said yet where it is.";
            return Optional.empty();
        }
        return switch (key) {
            case " " -> request(isPaused(replay) ? "resume" : "pause", Map.of());
            case "left" -> seek(replay, STEP.negated());
            case "right" -> seek(replay, STEP);
            case "[", "shift-left" -> seek(replay, LEAP.negated());
            case "]", "shift-right" -> seek(replay, LEAP);
            case "." -> step(replay, 1);
            case "," -> step(replay, -1);
            case "+", "=" -> speed(replay, 2);
            case "-" -> speed(replay, 0.5);
            case "l" -> loop(replay);
            case "m" -> begin(replay);
            case "?" -> {
                help = !help;
                yield Optional.empty();
            }
            default -> Optional.empty();
        };
    }

    private Optional<Request> type(String key, JsonNode replay) {
        switch (key) {
            case "escape" -> note = null;
            case "backspace" -> note.setLength(Math.max(0, note.length() - 1));
            case "enter" -> {
                String text = note.toString().strip();
                note = null;
                if (!text.isEmpty()) {
                    return request(
                            MarkerCommand.path(replay.path("mission").asText()),
                            Map.of("time", noteTime, "note", text));
                }
            }
            default -> {
                if (key.length() == 1) {
                    note.append(key);
                }
            }
        }
        return Optional.empty();
    }

    private Optional<Request> begin(JsonNode replay) {
        note = new StringBuilder();
        noteTime = position(replay);
        return Optional.empty();
    }

    /** Relative to the target of the last seek, until the replay reports another position. */
    private Optional<Request> seek(JsonNode replay, Duration by) {
        PlayedRange part = PlayedRange.of(replay);
        long position = position(replay);
        long begin = position == soughtFrom ? sought : position;
        soughtFrom = position;
        sought = Math.max(part.from(), Math.min(part.last(), begin + by.toMillis()));
        return request("seek", Map.of("to", sought));
    }

    private Optional<Request> step(JsonNode replay, int count) {
        boolean ended = replay.at("/status/state").asText().equals("ended");
        if (ended && count > 0) {
            message = "It has ended; , steps back.";
            return Optional.empty();
        } else if (!ended && !isPaused(replay)) {
            message = "Pause it first: space.";
            return Optional.empty();
        }
        return request("step", Map.of("count", count));
    }

    private Optional<Request> speed(JsonNode replay, double factor) {
        boolean max = !replay.path("speed").isNumber();
        if (max && factor > 1) {
            message = "It plays as fast as it goes.";
            return Optional.empty();
        }
        double speed = max ? FASTEST : replay.path("speed").asDouble() * factor;
        return request("speed", Map.of("speed", Math.max(SLOWEST, Math.min(FASTEST, speed))));
    }

    private Optional<Request> loop(JsonNode replay) {
        if (loopFrom == null && replay.hasNonNull("range")) {
            return request("loop", Map.of());
        } else if (loopFrom == null) {
            loopFrom = position(replay);
            message = "The range begins here; press l where it ends.";
            return Optional.empty();
        }
        long from = Math.min(loopFrom, position(replay));
        long to = Math.max(loopFrom, position(replay));
        loopFrom = null;
        if (from == to) {
            message = "A range needs two different times.";
            return Optional.empty();
        }
        return request("loop", Map.of("from", from, "to", to));
    }

    private static Optional<Request> request(String path, Map<String, Object> body) {
        return Optional.of(new Request(path, body));
    }

    private static boolean isPaused(JsonNode replay) {
        return replay.path("wanted").asText().equals("paused");
    }

    private static long position(JsonNode replay) {
        return replay.at("/status/progress/position").asLong();
    }
}
