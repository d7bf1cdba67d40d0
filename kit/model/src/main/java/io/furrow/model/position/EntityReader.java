package io.furrow.model.position;

import java.io.IOException;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Numbers;
import io.furrow.model.ngsi.Quantity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.Utf8;

/**
 * Reads id, type, position and the desired attributes from the bytes of a normalized entity, without a tree or a copy,
 * and skips everything else. Its results equal those of {@link Entity#parse(byte[], Set)} and {@link
 * PositionReading#of}, which read invalid and rare input. A reader is reused for many entities; getters return the
 * newest. Not thread-safe.
 */
public final class EntityReader {
    private final Set<String> desired;
    private final Map<String, AttributeValue> values = new HashMap<>();
    private final LocationValue location = new LocationValue();
    private final FirosMessage firos = new FirosMessage();
    private final StrictTokens tokens = new StrictTokens();

    private String id;
    private String type = "";
    /** The desired attributes if the entity was read as a tree; otherwise null. */
    private Entity tree;

    /** Creates a reader of these attributes and those of the position. */
    public EntityReader(Set<String> attributes) {
        values.put("location", location);
        PositionReading.ATTRIBUTES.forEach(name -> values.computeIfAbsent(name, any -> new AttributeValue()));
        attributes.forEach(name -> values.computeIfAbsent(name, any -> new AttributeValue()));
        desired = Set.copyOf(values.keySet());
    }

    /**
     * Reads an entity and clears the previous one, even if this one is unreadable.
     *
     * @throws UnreadableException as {@link Entity#parse(byte[], Set)}
     */
    public void read(byte[] normalized) throws UnreadableException {
        tree = null;
        if (!readTokens(normalized)) {
            tree = Entity.parse(normalized, desired);
        }
    }

    /** Reads an entity without a tree; returns false if it is invalid or rare. */
    boolean readTokens(byte[] normalized) {
        id = null;
        values.values().forEach(AttributeValue::clear);
        try (JsonParser parser = tokens.open(normalized, normalized.length)) {
            return Utf8.firstWrong(normalized) < 0 && readEntity(parser);
        } catch (IOException | NumberFormatException e) { // the tree reader reports the cause
            return false;
        }
    }

    private boolean readEntity(JsonParser parser) throws IOException {
        if (tokens.next() != JsonToken.START_OBJECT) {
            return false;
        }
        boolean typed = false;
        while (tokens.next() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            JsonToken value = tokens.next();
            boolean isRead;
            if (name.equals("id") || name.equals("type")) {
                isRead = value == JsonToken.VALUE_STRING && tokens.isPlainText();
                typed |= name.equals("type");
                readName(name, parser);
            } else {
                isRead = value == JsonToken.START_OBJECT && isPlain(name) && readAttribute(values.get(name), parser);
            }
            if (!isRead) {
                return false;
            }
        }
        type = typed ? type : "Thing";
        boolean complete = parser.currentToken() == JsonToken.END_OBJECT && tokens.next() == null;
        return complete && id != null && !id.isBlank();
    }

    private void readName(String name, JsonParser parser) throws IOException {
        if (name.equals("id")) {
            id = parser.getText();
        } else {
            type = tokens.isText(type) ? type : parser.getText();
        }
    }

    private static boolean isPlain(String name) {
        for (int i = 0; i < name.length(); i++) {
            if (Character.isSurrogate(name.charAt(i))) {
                return false;
            }
        }
        return true;
    }

    /**
     * Reads the current attribute.
     *
     * @param attribute null if it is not desired: it is then only checked, because all invalid input is rejected
     */
    private boolean readAttribute(AttributeValue attribute, JsonParser parser) throws IOException {
        boolean valued = false;
        while (tokens.next() == JsonToken.FIELD_NAME) {
            boolean value = parser.currentName().equals("value");
            boolean metadata = !value && parser.currentName().equals("metadata");
            valued |= value;
            tokens.next();
            boolean isRead = attribute != null && value
                    ? attribute.read(tokens, parser)
                    : attribute != null && metadata
                            ? attribute.readMetadata(tokens, parser)
                            : tokens.skipWithinLimits();
            if (!isRead) {
                return false;
            }
        }
        return valued && parser.currentToken() == JsonToken.END_OBJECT;
    }

    public String id() {
        return tree == null ? id : tree.id();
    }

    /** Returns the type; {@code Thing} if none was reported. */
    public String type() {
        return tree == null ? type : tree.type();
    }

    public PositionReading position() {
        if (tree != null) {
            return PositionReading.of(tree);
        }
        if (location.isPresent() && !location.isBlank()) {
            return location.position();
        }
        for (PositionParser.Pair names : PositionParser.PAIRS) {
            AttributeValue latitude = values.get(names.latitude());
            AttributeValue longitude = values.get(names.longitude());
            if (latitude.isPresent() || longitude.isPresent()) {
                return PositionParser.of(latitude.finite(), longitude.finite());
            }
        }
        String message = text("gnss").or(() -> text("pose")).orElse(null);
        return message == null ? new PositionReading.Absent() : firos.read(message);
    }

    /** Returns whether the entity has the attribute with a value other than null. */
    public boolean has(String attribute) {
        return tree == null
                ? value(attribute).isPresent()
                : tree.value(attribute).isPresent();
    }

    /** Returns the value of a desired attribute as text; empty if it is missing, blank or not text. */
    public Optional<String> text(String attribute) {
        return tree == null
                ? Optional.ofNullable(value(attribute).textOrNull()).filter(text -> !text.isBlank())
                : tree.text(attribute);
    }

    /** Returns the value of a desired attribute as a name: its text, or the digits of a whole number. */
    public Optional<String> name(String attribute) {
        return text(attribute).or(() -> Numbers.digits(number(attribute)));
    }

    /** Returns the value of a desired attribute as a truth value; empty if it is missing or none. */
    public Optional<Boolean> truth(String attribute) {
        return tree == null
                ? Optional.ofNullable(value(attribute).truthOrNull())
                : tree.value(attribute).filter(JsonNode::isBoolean).map(JsonNode::booleanValue);
    }

    /** Returns the value of a desired attribute as a finite number, also if it was sent as text; otherwise NaN. */
    public double number(String attribute) {
        return tree == null ? value(attribute).finite() : tree.number(attribute).orElse(Double.NaN);
    }

    /** Returns a desired attribute as a quantity, in its unit; NaN if it is not a number or has an unknown unit. */
    public double number(String attribute, Quantity quantity) {
        return tree == null
                ? quantity.read(value(attribute).finite(), value(attribute).unit())
                : quantity.of(tree, attribute).orElse(Double.NaN);
    }

    private AttributeValue value(String attribute) {
        AttributeValue value = values.get(attribute);
        if (value == null) {
            throw new IllegalArgumentException("'" + attribute + "' is not one of the requested attributes " + desired);
        }
        return value;
    }
}
