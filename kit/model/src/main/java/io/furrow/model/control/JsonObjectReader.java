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

/** The members of a request, each read as what it must be or refused by name. Null counts as missing. */
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

    /** A legal name of a domain, a mission or a template. */
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

    /** Null if it is missing. */
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

    /** Null if it is missing. */
    String textOrNull(String member) throws RejectedException {
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

    /** False if it is missing. */
    boolean flag(String member) throws RejectedException {
        if (!has(member)) {
            return false;
        }
        refuseIf(!json.get(member).isBoolean(), member, "true or false");
        return json.get(member).booleanValue();
    }

    int wholeNumber(String member, int least, int most, int missing) throws RejectedException {
        if (!has(member)) {
            return missing;
        }
        JsonNode value = json.get(member);
        refuseIf(
                !value.isIntegralNumber()
                        || !value.canConvertToInt()
                        || value.intValue() < least
                        || value.intValue() > most,
                member,
                "a whole number from " + least + " to " + most);
        return value.intValue();
    }

    long number(String member) throws RejectedException {
        JsonNode value = json.path(member);
        refuseIf(!value.isIntegralNumber() || !value.canConvertToLong(), member, "a whole number");
        return value.longValue();
    }

    /** Null if it is missing. */
    Double numberOrNull(String member, double least, double most) throws RejectedException {
        if (!has(member)) {
            return null;
        }
        JsonNode value = json.get(member);
        double number = value.isNumber() ? value.doubleValue() : Double.NaN;
        if (!(number >= least && number <= most)) {
            throw wrong(member, "a number from %s to %s".formatted(plain(least), plain(most)));
        }
        return number;
    }

    /** ISO 8601 with an offset, or epoch ms. */
    public Instant time(String member) throws RejectedException {
        Instant time = timeOrNull(member);
        if (time == null) {
            throw missing(member);
        }
        return time;
    }

    /** ISO 8601 with an offset, or epoch ms; null if it is missing. */
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

    /** Years of four digits only, so that every later sum of times stays within a long. */
    private static Instant checked(String member, Instant time) throws RejectedException {
        refuseIf(
                time.isBefore(Instant.EPOCH) || time.isAfter(Instant.parse("9999-12-31T23:59:59Z")),
                member,
                "a time from 1970 to 9999");
        return Instant.ofEpochMilli(time.toEpochMilli());
    }

    /** ISO 8601 such as {@code PT90S}, above zero and at most ten years; null if it is missing. */
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
            // Said below, as for a duration that is out of range.
        }
        throw wrong(member, "a duration such as PT90S or PT2H, above zero and at most ten years");
    }

    /** Null if it is missing. */
    ObjectNode objectOrNull(String member) throws RejectedException {
        refuseIf(has(member) && !(json.get(member) instanceof ObjectNode), member, "an object");
        return has(member) ? (ObjectNode) json.get(member) : null;
    }

    /**
     * Refuses an area whose inside is ambiguous.
     *
     * @param name what the message calls it
     */
    static void checkArea(JsonNode area, String name) throws RejectedException {
        try {
            FieldArea.read(area, name);
        } catch (UnreadableException e) {
            throw new RejectedException(ErrorCode.WRONG_MEMBER, e.getMessage());
        }
    }

    /** Makes something of the members of an object. */
    interface Part<T> {
        T read(JsonObjectReader members) throws RejectedException;
    }

    /** What the members of an object are; null if it is missing. */
    <T> T partOrNull(String member, Part<T> part) throws RejectedException {
        ObjectNode object = objectOrNull(member);
        return object == null ? null : part.read(new JsonObjectReader(object));
    }

    /** Null if it is missing. */
    ArrayNode arrayOrNull(String member, int most) throws RejectedException {
        refuseIf(
                has(member) && !(json.get(member) instanceof ArrayNode array && array.size() <= most),
                member,
                "a list of at most " + most);
        return has(member) ? (ArrayNode) json.get(member) : null;
    }

    /** Texts that fit a pattern; none where it is missing. */
    List<String> texts(String member, Pattern form, String said) throws RejectedException {
        List<String> texts = new ArrayList<>();
        ArrayNode array = arrayOrNull(member, 10_000);
        for (JsonNode each : array == null ? List.<JsonNode>of() : array) {
            refuseIf(!each.isTextual() || !form.matcher(each.textValue()).matches(), member, "a list of " + said);
            texts.add(each.textValue());
        }
        return List.copyOf(texts);
    }

    static RejectedException missing(String member) {
        return new RejectedException(ErrorCode.MISSING_MEMBER, "the request needs a member '" + member + "'");
    }

    public static RejectedException wrong(String member, String rightForm) {
        return new RejectedException(ErrorCode.WRONG_MEMBER, "'%s' must be %s".formatted(member, rightForm));
    }

    public static void refuseIf(boolean isWrong, String member, String rightForm) throws RejectedException {
        if (isWrong) {
            throw wrong(member, rightForm);
        }
    }

    /** As it may stand in a sentence: printable ASCII, not too long. */
    static String quotable(String text) {
        String start = text.length() > MAX_QUOTE_LENGTH ? text.substring(0, MAX_QUOTE_LENGTH) + "..." : text;
        return NOT_PRINTABLE.matcher(start).replaceAll("?");
    }

    /** Refuses what could be read here but not by whoever reads what is made of it. */
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

    /** Half of a surrogate pair has no form in UTF-8. */
    private static void checkUnicode(String text) throws RejectedException {
        if (!StandardCharsets.UTF_8.newEncoder().canEncode(text)) {
            throw new RejectedException(ErrorCode.NOT_JSON, "a text holds half of a surrogate pair");
        }
    }

    private static String plain(double number) {
        return BigDecimal.valueOf(number).stripTrailingZeros().toPlainString();
    }
}
