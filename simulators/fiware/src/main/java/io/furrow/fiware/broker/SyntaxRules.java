package io.furrow.fiware.broker;

import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.fiware.http.NgsiError;
import io.furrow.model.ngsi.Entity;

/**
 * Refuses names and values with characters that Orion forbids: in values {@code < > " ' = ; ( )}, in texts at any
 * depth, unless the attribute is of type {@code TextUnrestricted}; names of members of structured values are free.
 */
public final class SyntaxRules {
    private static final String UNRESTRICTED = "TextUnrestricted";
    private static final Pattern IDENTIFIER = Pattern.compile("[\\x21-\\x7e&&[^&?/#<>\"'=;()]]{1,256}");
    private static final Pattern FORBIDDEN = Pattern.compile("[<>\"'=;()]");
    private static final int MAX_LENGTH = 256;
    private static final Set<String> MEMBERS = Set.of("id", "type");

    private SyntaxRules() {}

    public static void checkEntity(String id, Optional<String> type) throws NgsiError {
        checkIdentifier(id, "entity id");
        if (type.isPresent()) {
            checkIdentifier(type.get(), "entity type");
        }
    }

    /** Whether an entity has a member or a built-in attribute of this name, so that no attribute can have it. */
    public static boolean isReserved(String name) {
        return MEMBERS.contains(name) || Entity.BUILT_INS.contains(name);
    }

    public static void checkAttributeName(String name) throws NgsiError {
        checkIdentifier(name, "attribute name");
        if (isReserved(name)) {
            throw NgsiError.badRequest("the name '" + name + "' is reserved and cannot be that of an attribute");
        }
    }

    /** A regular expression, for a part of a text. */
    public static Predicate<String> pattern(String regex) throws NgsiError {
        try {
            return Pattern.compile(regex).asPredicate();
        } catch (PatternSyntaxException e) {
            throw NgsiError.badRequest("invalid regular expression: " + regex);
        }
    }

    /** Checks all names of an entity: whatever is stored has passed it. */
    public static void checkNames(EntityUpdate request) throws NgsiError {
        checkEntity(request.id(), request.type());
        for (String name : request.attributes().keySet()) {
            checkAttributeName(name);
        }
    }

    /** Checks type, value and metadata, including dates. */
    public static void check(AttributeInput attribute) throws NgsiError {
        String type = attribute.type().orElse("");
        if (attribute.type().isPresent()) {
            checkIdentifier(type, "attribute type");
        }
        if (!type.equals(UNRESTRICTED)) {
            checkValue(attribute.value(), "attribute value");
        }
        AttributeInput.dated(type, attribute.value(), "attribute value");
        if (attribute.metadata().isPresent()) {
            for (var entry : attribute.metadata().get().properties()) {
                checkIdentifier(entry.getKey(), "metadata name");
                JsonNode value = entry.getValue().path("value");
                checkValue(value, "metadata value");
                AttributeInput.dated(entry.getValue().path("type").asText(), value, "metadata value");
            }
        }
    }

    private static void checkValue(JsonNode value, String what) throws NgsiError {
        if (value.isTextual() && FORBIDDEN.matcher(value.textValue()).find()) {
            throw NgsiError.badRequest("Invalid characters in " + what);
        }
        for (JsonNode member : value) {
            checkValue(member, what);
        }
    }

    private static void checkIdentifier(String text, String what) throws NgsiError {
        if (text.isEmpty()) {
            throw NgsiError.badRequest(what + " length: 0, min length supported: 1");
        }
        if (text.length() > MAX_LENGTH) {
            throw NgsiError.badRequest(what + " length: " + text.length() + ", max length supported: " + MAX_LENGTH);
        }
        if (!IDENTIFIER.matcher(text).matches()) {
            throw NgsiError.badRequest("Invalid characters in " + what);
        }
    }
}
