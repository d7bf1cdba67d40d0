package io.furrow.fiware.broker;

import java.math.BigDecimal;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Predicate;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

/** The right side of a comparison: a number, a date, a boolean or a text; values of other types do not compare. */
record QueryOperand(String text, Optional<BigDecimal> number, Optional<Instant> time, Optional<Boolean> truth) {
    private static final Pattern NUMBER = Pattern.compile("[+-]?\\d{1,30}(\\.\\d{1,30})?([eE][+-]?\\d{1,3})?");
    private static final Pattern ITEM = Pattern.compile("('[^']*'|[^',])+");

    static QueryOperand of(String raw) {
        String text = raw.trim();
        if (text.length() >= 2 && text.startsWith("'") && text.endsWith("'")) {
            String inner = text.substring(1, text.length() - 1);
            return new QueryOperand(inner, Optional.empty(), Optional.empty(), Optional.empty());
        }
        Optional<BigDecimal> number =
                NUMBER.matcher(text).matches() ? Optional.of(new BigDecimal(text)) : Optional.empty();
        Optional<Boolean> truth =
                text.equals("true") || text.equals("false") ? Optional.of(text.equals("true")) : Optional.empty();
        return new QueryOperand(text, number, number.isPresent() ? Optional.empty() : NgsiTime.parse(text), truth);
    }

    /** Tests equality with one of a list, or inclusion in a range with both ends. */
    static Predicate<JsonNode> anyOf(String operand) {
        int dots = operand.startsWith("'") ? -1 : operand.indexOf("..");
        if (dots > 0) {
            QueryOperand low = of(operand.substring(0, dots));
            QueryOperand high = of(operand.substring(dots + 2));
            return value -> low.compare(value).stream().anyMatch(order -> order >= 0)
                    && high.compare(value).stream().anyMatch(order -> order <= 0);
        }
        List<QueryOperand> items = new ArrayList<>();
        Matcher matcher = ITEM.matcher(operand);
        while (matcher.find()) {
            items.add(of(matcher.group()));
        }
        return value -> items.stream().anyMatch(item -> item.equalTo(value));
    }

    /** Compares the value with this operand: negative, zero or positive; empty if not comparable. */
    Optional<Integer> compare(JsonNode value) {
        if (value.isNumber()) {
            return number.map(other -> value.decimalValue().compareTo(other));
        }
        if (value.isBoolean()) {
            return truth.map(other -> Boolean.compare(value.booleanValue(), other));
        }
        if (!value.isTextual() || number.isPresent() || truth.isPresent()) {
            return Optional.empty();
        }
        Optional<Instant> valueTime = time.flatMap(other -> NgsiTime.parse(value.textValue()));
        return valueTime.isPresent()
                ? valueTime.map(at -> at.compareTo(time.orElseThrow()))
                : Optional.of(value.textValue().compareTo(text));
    }

    /** An array equals the values of its elements. */
    private boolean equalTo(JsonNode value) {
        if (value.isArray()) {
            for (JsonNode element : value) {
                if (equalTo(element)) {
                    return true;
                }
            }
            return false;
        }
        if (value.isNull()) {
            return text.equals("null");
        }
        return compare(value).stream().anyMatch(order -> order == 0);
    }
}
