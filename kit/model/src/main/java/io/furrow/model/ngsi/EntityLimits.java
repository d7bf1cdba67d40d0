package io.furrow.model.ngsi;

import java.math.BigDecimal;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * Checks limits of entities, so that all later readers accept them: the normalized form is nested at most {@link
 * NgsiJson#MAX_NESTING} levels, texts are valid Unicode, numbers have at most {@value #MAX_EXPONENT} digits on either
 * side of the point.
 */
final class EntityLimits {
    /** Far above a double's 308. A number of 10⁹ digits has a short notation but would fill the memory of readers. */
    static final int MAX_EXPONENT = 1000;

    private EntityLimits() {}

    static void check(JsonNode normalized) throws UnreadableException {
        check(normalized, 1);
    }

    private static void check(JsonNode node, int depth) throws UnreadableException {
        if (node.isContainerNode() && depth > NgsiJson.MAX_NESTING) {
            throw new UnreadableException(
                    Reason.TOO_DEEP,
                    "the entity is nested deeper than " + NgsiJson.MAX_NESTING + " in normalized form");
        }
        if (node.isObject()) {
            for (var member : node.properties()) {
                checkText(member.getKey());
                check(member.getValue(), depth + 1);
            }
        } else if (node.isArray()) {
            for (JsonNode element : node) {
                check(element, depth + 1);
            }
        } else if (node.isTextual()) {
            checkText(node.textValue());
        } else if (node.isBigDecimal()) {
            checkExponent(node.decimalValue());
        }
    }

    /** Rejects half of a surrogate pair, which would become a question mark in record keys and hashes. */
    static void checkText(String text) throws UnreadableException {
        for (int i = 0; i < text.length(); i++) {
            if (Character.isSurrogate(text.charAt(i))) {
                boolean pair = i + 1 < text.length() && Character.isSurrogatePair(text.charAt(i), text.charAt(i + 1));
                Reason.NOT_AN_ENTITY.refuseIf(!pair, "a text holds half of a surrogate pair");
                i++;
            }
        }
    }

    static void checkExponent(BigDecimal number) throws UnreadableException {
        long exponent = (long) number.precision() - number.scale();
        if (Math.abs(exponent) > MAX_EXPONENT) {
            throw new UnreadableException(
                    Reason.TOO_DEEP, "a number has an exponent beyond " + MAX_EXPONENT + ", which no device needs");
        }
    }
}
