package io.furrow.model.position;

import java.io.IOException;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Quantity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.Utf8;

/**
 * Reads id, type, position and the requested attributes from the bytes of a normalized entity, without a tree and
 * without a copy; skips everything else. It answers as {@link Entity#parse(byte[], Set)} and {@link
 * PositionReading#of} do, to the last case: what is wrong, and what is so rare that it is not worth a line here, is
 * read by them. One reader reads one entity after the other; the answers are about the newest. Not safe for threads.
 */
public final class EntityReader {
    private final Set<String> desired;
    private final Map<String, AttributeValue> values = new HashMap<>();
    private final LocationValue location = new LocationValue();
    private final FirosMessage firos = new FirosMessage();
    private final StrictTokens tokens = new StrictTokens();

    private String id;
    private String type = "";
    /** The whole of what is requested, where it was read as a tree; else null. */
    private Entity tree;

    /** Reads these attributes beside those of the position. */
    public EntityReader(Set<String> attributes) {
        values.put("location", location);
        PositionReading.ATTRIBUTES.forEach(name -> values.computeIfAbsent(name, any -> new AttributeValue()));
        attributes.forEach(name -> values.computeIfAbsent(name, any -> new AttributeValue()));
        desired = Set.copyOf(values.keySet());
    }

    /**
     * Reads an entity; the former one is forgotten, also when this one cannot be read.
     *
     * @throws UnreadableException as {@link Entity#parse(byte[], Set)}
     */
    public void read(byte[] normalized) throws UnreadableException {
        tree = null;
        if (!readTokens(normalized)) {
            tree = Entity.parse(normalized, desired);
        }
    }

    /** Whether the entity could be read so; where not, something in it is wrong or rare. */
    boolean readTokens(byte[] normalized) {
        id = null;
        values.values().forEach(AttributeValue::clear);
        try (JsonParser parser = tokens.open(normalized, normalized.length)) {
            return Utf8.firstWrong(normalized) < 0 && takeEntity(parser);
        } catch (IOException | NumberFormatException e) { // the reader of trees meets it again and says what it is
            return false;
        }
    }

    private boolean takeEntity(JsonParser parser) throws IOException {
        if (tokens.next() != JsonToken.START_OBJECT) {
            return false;
        }
        boolean typed = false;
        while (tokens.next() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            JsonToken value = tokens.next();
            boolean taken;
            if (name.equals("id") || name.equals("type")) {
                taken = value == JsonToken.VALUE_STRING && tokens.isPlainText();
                typed |= name.equals("type");
                takeName(name, parser);
            } else {
                taken = value == JsonToken.START_OBJECT && isPlain(name) && takeAttribute(values.get(name), parser);
            }
            if (!taken) {
                return false;
            }
        }
        type = typed ? type : "Thing";
        boolean complete = parser.currentToken() == JsonToken.END_OBJECT && tokens.next() == null;
        return complete && id != null && !id.isBlank();
    }

    private void takeName(String name, JsonParser parser) throws IOException {
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
     * Takes the attribute whose object has just begun; {@code attribute} is null if it is not wanted: then it is only
     * looked at, because what is refused anywhere is refused here.
     */
    private boolean takeAttribute(AttributeValue attribute, JsonParser parser) throws IOException {
        boolean valued = false;
        while (tokens.next() == JsonToken.FIELD_NAME) {
            boolean value = parser.currentName().equals("value");
            boolean metadata = !value && parser.currentName().equals("metadata");
            valued |= value;
            tokens.next();
            boolean taken = attribute != null && value
                    ? attribute.take(tokens, parser)
                    : attribute != null && metadata
                            ? attribute.takeMetadata(tokens, parser)
                            : tokens.skipWithinLimits();
            if (!taken) {
                return false;
            }
        }
        return valued && parser.currentToken() == JsonToken.END_OBJECT;
    }

    public String id() {
        return tree == null ? id : tree.id();
    }

    /** The type; {@code Thing} where none was reported. */
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

    /** Whether the entity has the attribute and its value is not null. */
    public boolean has(String attribute) {
        return tree == null
                ? value(attribute).isPresent()
                : tree.value(attribute).isPresent();
    }

    /** The value of a wanted attribute as text; empty if it is missing, blank or no text. */
    public Optional<String> text(String attribute) {
        return tree == null
                ? Optional.ofNullable(value(attribute).textOrNull()).filter(text -> !text.isBlank())
                : tree.text(attribute);
    }

    /** The value of a wanted attribute as a finite number, also where a device sent it as text; else NaN. */
    public double number(String attribute) {
        return tree == null ? value(attribute).finite() : tree.number(attribute).orElse(Double.NaN);
    }

    /** The value of a wanted attribute as a quantity, in its unit; NaN if it is not a number, or in an unknown unit. */
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
