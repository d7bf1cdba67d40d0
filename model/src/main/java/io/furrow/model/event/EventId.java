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
        MessageDigest digest = sha256();
        addText(digest, scope.service());
        addText(digest, scope.servicePath());
        addText(digest, entity.id());
        add(digest, Long.toString(eventTime.toEpochMilli()));
        TreeMap<String, JsonNode> values = new TreeMap<>();
        for (Map.Entry<String, JsonNode> attribute : entity.attributes()) {
            if (!Entity.BUILT_INS.contains(attribute.getKey())) {
                values.put(attribute.getKey(), attribute.getValue().path("value"));
            }
        }
        values.forEach((name, value) -> {
            addText(digest, name);
            addValue(digest, value);
        });
        return HexFormat.of().formatHex(digest.digest()).substring(0, HEX_DIGITS);
    }

    /** The id of a deletion: no change of the same entity at the same time has it. */
    static String ofDeletion(FiwareScope scope, String entityId, Instant eventTime) {
        MessageDigest digest = sha256();
        addText(digest, scope.service());
        addText(digest, scope.servicePath());
        addText(digest, entityId);
        add(digest, Long.toString(eventTime.toEpochMilli()));
        add(digest, "deleted");
        return HexFormat.of().formatHex(digest.digest()).substring(0, HEX_DIGITS);
    }

    private static void addValue(MessageDigest digest, JsonNode value) {
        switch (value.getNodeType()) {
            case OBJECT -> {
                TreeMap<String, JsonNode> members = new TreeMap<>();
                value.properties().forEach(member -> members.put(member.getKey(), member.getValue()));
                add(digest, "{" + members.size());
                members.forEach((name, member) -> {
                    addText(digest, name);
                    addValue(digest, member);
                });
            }
            case ARRAY -> {
                add(digest, "[" + value.size());
                value.forEach(element -> addValue(digest, element));
            }
            case STRING -> addText(digest, value.textValue());
            case NUMBER -> add(digest, "#" + canonical(value.decimalValue()));
            default -> add(digest, value.asText("null"));
        }
    }

    /** The length before the text makes the whole injective: no separator can be part of a text. */
    private static void addText(MessageDigest digest, String part) {
        add(digest, "\"" + part.length() + ":");
        add(digest, part);
    }

    private static void add(MessageDigest digest, String part) {
        digest.update(part.getBytes(StandardCharsets.UTF_8));
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
