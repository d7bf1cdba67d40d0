package io.furrow.model.event;

import java.math.BigDecimal;
import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.time.Instant;
import java.util.HexFormat;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;

/**
 * The id of an event: the first 128 bits of a SHA-256 over tenant, service path, entity id, event time and the sorted
 * attribute name and value pairs, in lower-case hexadecimal. Types, metadata, built-ins, the order of attributes and the
 * way a number is written (18, 18.0, 1.8e1) make no difference, because they differ between notifications of one change.
 */
public final class EventId {
    private static final int HEX_DIGITS = 32;

    private EventId() {}

    public static String of(FiwareScope scope, Entity entity, Instant eventTime) {
        StringBuilder text = new StringBuilder(256);
        appendText(text, scope.service());
        appendText(text, scope.servicePath());
        appendText(text, entity.id());
        text.append(eventTime.toEpochMilli());
        TreeMap<String, JsonNode> values = new TreeMap<>();
        for (Map.Entry<String, JsonNode> attribute : entity.attributes()) {
            if (!Entity.BUILT_INS.contains(attribute.getKey())) {
                values.put(attribute.getKey(), attribute.getValue().path("value"));
            }
        }
        values.forEach((name, value) -> {
            appendText(text, name);
            appendValue(text, value);
        });
        byte[] digest = sha256().digest(text.toString().getBytes(StandardCharsets.UTF_8));
        return HexFormat.of().formatHex(digest).substring(0, HEX_DIGITS);
    }

    private static void appendValue(StringBuilder text, JsonNode value) {
        switch (value.getNodeType()) {
            case OBJECT -> {
                TreeMap<String, JsonNode> members = new TreeMap<>();
                value.properties().forEach(member -> members.put(member.getKey(), member.getValue()));
                text.append('{').append(members.size());
                members.forEach((name, member) -> {
                    appendText(text, name);
                    appendValue(text, member);
                });
            }
            case ARRAY -> {
                text.append('[').append(value.size());
                value.forEach(element -> appendValue(text, element));
            }
            case STRING -> appendText(text, value.textValue());
            case NUMBER -> text.append('#').append(canonical(value.decimalValue()));
            default -> text.append(value.asText("null"));
        }
    }

    /** The length before the text makes the whole injective: no separator can be part of a text. */
    private static void appendText(StringBuilder text, String part) {
        text.append('"').append(part.length()).append(':').append(part);
    }

    private static String canonical(BigDecimal number) {
        return number.signum() == 0 ? "0" : number.stripTrailingZeros().toString();
    }

    private static MessageDigest sha256() {
        try {
            return MessageDigest.getInstance("SHA-256");
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("every Java platform has SHA-256", e);
        }
    }
}
