package io.furrow.model.control;

import java.math.BigDecimal;
import java.nio.charset.StandardCharsets;
import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.field.FieldArea;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.TopicName;

/** Reads the members of a request by type; rejections name the member. Null counts as missing. */
public final class JsonObjectReader {
    private static final int MAX_TEXT_LENGTH = 4096;
    private static final int MAX_QUOTE_LENGTH = 80;
    private static final int MAX_DIGITS = 1000;
    private static final Pattern NOT_PRINTABLE = Pattern.compile("[^ -~]");

    private final ObjectNode json;

    public JsonObjectReader(ObjectNode json) {
        this.json = json;
    }

    ObjectNode json() {
        return json;
    }

    boolean has(String member) {
        return json.hasNonNull(member);
    }

    /** Reads a legal name of a domain, a mission or a template. */
    String name(String member) throws RejectedException {
        String name = text(member);
        if (!TopicName.isLegal(name)) {
            throw new RejectedException(
                    ErrorCode.ILLEGAL_NAME,
                    "'%s' is not a name for '%s': it takes 1 to 64 of A-Z a-z 0-9 _ -"
                            .formatted(quotable(name), member));
        }
        return name;
    }

    /** Returns null if it is missing. */
    String nameOrNull(String member) throws RejectedException {
        return has(member) ? name(member) : null;
    }

    public String text(String member) throws RejectedException {
        String text = textOrNull(member);
        if (text == null) {
            throw missing(member);
        }
        return text;
    }

    /** Returns null if it is missing. */
    public String textOrNull(String member) throws RejectedException {
        if (!has(member)) {
            return null;
        }
        JsonNode value = json.get(member);
        refuseIf(
                !value.isTextual() || value.textValue().length() > MAX_TEXT_LENGTH,
                member,
                "a text of at most " + MAX_TEXT_LENGTH + " characters");
        return value.textValue();
    }

    /** Returns false if it is missing. */
    public boolean flag(String member) throws RejectedException {
        if (!has(member)) {
            return false;
        }
        refuseIf(!json.get(member).isBoolean(), member, "true or false");
        return json.get(member).booleanValue();
    }

    int wholeNumber(String member, int min, int max, int missing) throws RejectedException {
        if (!has(member)) {
            return missing;
        }
        JsonNode value = json.get(member);
        refuseIf(
                !value.isIntegralNumber()
                        || !value.canConvertToInt()
                        || value.intValue() < min
                        || value.intValue() > max,
                member,
                "a whole number from " + min + " to " + max);
        return value.intValue();
    }

    long number(String member) throws RejectedException {
        JsonNode value = json.path(member);
        refuseIf(!value.isIntegralNumber() || !value.canConvertToLong(), member, "a whole number");
        return value.longValue();
    }

    /** Returns null if it is missing. */
    Double numberOrNull(String member, double min, double max) throws RejectedException {
        if (!has(member)) {
            return null;
        }
        JsonNode value = json.get(member);
        double number = value.isNumber() ? value.doubleValue() : Double.NaN;
        if (!(number >= min && number <= max)) {
            throw wrong(member, "a number from %s to %s".formatted(plain(min), plain(max)));
        }
        return number;
    }

    /** Reads a time in ISO 8601 with an offset, or in epoch ms. */
    public Instant time(String member) throws RejectedException {
        Instant time = timeOrNull(member);
        if (time == null) {
            throw missing(member);
        }
        return time;
    }

    /** Reads a time in ISO 8601 with an offset, or in epoch ms; null if it is missing. */
    Instant timeOrNull(String member) throws RejectedException {
        if (!has(member)) {
            return null;
        }
        JsonNode value = json.get(member);
        if (value.isIntegralNumber() && value.canConvertToLong() && value.longValue() >= 0) {
            return checked(member, Instant.ofEpochMilli(value.longValue()));
        }
        try {
            return checked(member, Instant.parse(value.isTextual() ? value.textValue() : ""));
        } catch (DateTimeException e) {
            throw wrong(member, "a time such as 2026-03-01T08:00:00Z, or epoch ms");
        }
    }

    /** Allows four-digit years only, so that later sums of times fit into a long. */
    private static Instant checked(String member, Instant time) throws RejectedException {
        refuseIf(
                time.isBefore(Instant.EPOCH) || time.isAfter(Instant.parse("9999-12-31T23:59:59Z")),
                member,
                "a time from 1970 to 9999");
        return Instant.ofEpochMilli(time.toEpochMilli());
    }

    /** Reads a duration in ISO 8601 such as {@code PT90S}, above zero and at most ten years; null if it is missing. */
    Duration durationOrNull(String member) throws RejectedException {
        if (!has(member)) {
            return null;
        }
        try {
            Duration duration = Duration.parse(
                    json.get(member).isTextual() ? json.get(member).textValue() : "");
            if (duration.compareTo(Duration.ofMillis(1)) >= 0 && duration.compareTo(Duration.ofDays(3660)) <= 0) {
                return duration;
            }
        } catch (DateTimeException e) {
            // Rejected below, like a duration that is out of range.
        }
        throw wrong(member, "a duration such as PT90S or PT2H, above zero and at most ten years");
    }

    /** Returns null if it is missing. */
    ObjectNode objectOrNull(String member) throws RejectedException {
        refuseIf(has(member) && !(json.get(member) instanceof ObjectNode), member, "an object");
        return has(member) ? (ObjectNode) json.get(member) : null;
    }

    /**
     * Rejects an area whose interior is ambiguous.
     *
     * @param name of the area in the message
     */
    static void checkArea(JsonNode area, String name) throws RejectedException {
        try {
            FieldArea.read(area, name);
        } catch (UnreadableException e) {
            throw new RejectedException(ErrorCode.WRONG_MEMBER, e.getMessage());
        }
    }

    /** Reads the members of an object. */
    interface Part<T> {
        T read(JsonObjectReader members) throws RejectedException;
    }

    /** Reads an object; null if it is missing. */
    <T> T partOrNull(String member, Part<T> part) throws RejectedException {
        ObjectNode object = objectOrNull(member);
        return object == null ? null : part.read(new JsonObjectReader(object));
    }

    /** Returns null if it is missing. */
    ArrayNode arrayOrNull(String member, int max) throws RejectedException {
        refuseIf(
                has(member) && !(json.get(member) instanceof ArrayNode array && array.size() <= max),
                member,
                "a list of at most " + max);
        return has(member) ? (ArrayNode) json.get(member) : null;
    }

    /** Reads texts that match a pattern; empty if it is missing. */
    public List<String> texts(String member, Pattern pattern, String description) throws RejectedException {
        List<String> texts = new ArrayList<>();
        ArrayNode array = arrayOrNull(member, 10_000);
        for (JsonNode each : array == null ? List.<JsonNode>of() : array) {
            refuseIf(
                    !each.isTextual() || !pattern.matcher(each.textValue()).matches(),
                    member,
                    "a list of " + description);
            texts.add(each.textValue());
        }
        return List.copyOf(texts);
    }

    static RejectedException missing(String member) {
        return new RejectedException(ErrorCode.MISSING_MEMBER, "the request needs a member '" + member + "'");
    }

    public static RejectedException wrong(String member, String expected) {
        return new RejectedException(ErrorCode.WRONG_MEMBER, "'%s' must be %s".formatted(member, expected));
    }

    public static void refuseIf(boolean isWrong, String member, String expected) throws RejectedException {
        if (isWrong) {
            throw wrong(member, expected);
        }
    }

    /** Returns a text that can be quoted in a message: printable ASCII of limited length. */
    static String quotable(String text) {
        String start = text.length() > MAX_QUOTE_LENGTH ? text.substring(0, MAX_QUOTE_LENGTH) + "..." : text;
        return NOT_PRINTABLE.matcher(start).replaceAll("?");
    }

    /** Rejects values that readers of the resulting records could not read. */
    public static void checkReadable(JsonNode node) throws RejectedException {
        if (node.isTextual()) {
            checkUnicode(node.textValue());
        } else if (node.isBigDecimal()) {
            BigDecimal number = node.decimalValue();
            if (Math.abs((long) number.precision() - number.scale()) > MAX_DIGITS) {
                throw new RejectedException(ErrorCode.NOT_JSON, "a number has an exponent beyond " + MAX_DIGITS);
            }
        }
        for (var member : node.properties()) {
            checkUnicode(member.getKey());
            checkReadable(member.getValue());
        }
        if (node.isArray()) {
            for (JsonNode element : node) {
                checkReadable(element);
            }
        }
    }

    /** Rejects half of a surrogate pair, which UTF-8 cannot encode. */
    private static void checkUnicode(String text) throws RejectedException {
        if (!StandardCharsets.UTF_8.newEncoder().canEncode(text)) {
            throw new RejectedException(ErrorCode.NOT_JSON, "a text holds half of a surrogate pair");
        }
    }

    private static String plain(double number) {
        return BigDecimal.valueOf(number).stripTrailingZeros().toPlainString();
    }
}
