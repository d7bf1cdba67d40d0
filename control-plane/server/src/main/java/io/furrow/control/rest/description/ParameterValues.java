package io.furrow.control.rest.description;

import java.time.DateTimeException;
import java.time.Instant;
import java.util.List;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.control.ErrorCode;

/** Checks values of query parameters: flags, whole numbers, one of several words, or given once. */
public final class ParameterValues {
    private static final Instant FIRST_TIME = Instant.parse("0000-01-01T00:00:00Z");
    private static final Instant LAST_TIME = Instant.parse("9999-12-31T23:59:59.999Z");

    private ParameterValues() {}

    /** @param schema of the parameter, as in the description of the API */
    public static void check(String name, List<String> values, JsonNode schema) {
        String type = schema.path("type").asText();
        if (type.equals("array")) {
            values.forEach(value -> check(name, List.of(value), schema.get("items")));
        } else if (type.equals("boolean")) {
            check(name, values, "true or false", value -> value.equals("true") || value.equals("false"));
        } else if (type.equals("integer")) {
            long min = schema.path("minimum").asLong(0);
            long max = schema.path("maximum").asLong(Long.MAX_VALUE);
            String range = schema.has("maximum") ? "from %d to %d".formatted(min, max) : "from %d".formatted(min);
            check(name, values, "a whole number " + range, value -> isWithin(value, min, max));
        } else if (schema.has("enum")) {
            List<String> words =
                    schema.get("enum").valueStream().map(JsonNode::asText).toList();
            check(name, values, "one of " + String.join(", ", words), words::contains);
        } else {
            check(name, values, "a text", value -> true);
        }
    }

    private static boolean isWithin(String value, long min, long max) {
        return value.matches("0|[1-9][0-9]{0,17}") && Long.parseLong(value) >= min && Long.parseLong(value) <= max;
    }

    private static void check(String name, List<String> values, String what, Predicate<String> isValid) {
        ProblemException.rejectIf(
                values.size() != 1 || !isValid.test(values.get(0)),
                ErrorCode.WRONG_MEMBER,
                "'%s' must be %s, and given once".formatted(name, what));
    }

    /**
     * Parses a time.
     *
     * @param values at most one, ISO 8601 or epoch ms
     * @return epoch ms
     */
    public static long time(String name, List<String> values, long defaultTime) {
        if (values.isEmpty()) {
            return defaultTime;
        }
        try {
            String text = values.get(0);
            Instant time =
                    text.matches("-?\\d{1,15}") ? Instant.ofEpochMilli(Long.parseLong(text)) : Instant.parse(text);
            if (!time.isBefore(FIRST_TIME) && !time.isAfter(LAST_TIME)) {
                return time.toEpochMilli();
            }
        } catch (DateTimeException e) {
            // rejected below
        }
        throw new ProblemException(
                ErrorCode.WRONG_MEMBER,
                "'%s' must be a time of the years 0 to 9999, such as 2026-03-01T08:00:00Z, or epoch ms"
                        .formatted(name));
    }
}
