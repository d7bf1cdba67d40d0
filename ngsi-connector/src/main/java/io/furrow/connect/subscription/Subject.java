package io.furrow.connect.subscription;

import java.util.List;
import java.util.Optional;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Selects the entities and changes of a subscription.
 *
 * @param idPattern a regular expression that is found in the id
 * @param types exact types; empty for any, or for those of the pattern
 * @param typePattern a regular expression that is found in the type; only without types
 * @param alterationTypes as in Orion since 3.7; empty for its default, entityCreate and entityChange
 */
public record Subject(
        String idPattern, List<String> types, Optional<String> typePattern, List<String> alterationTypes) {
    /** All changes that Orion notifies by default. */
    public static final Subject ANY = new Subject(".*", List.of(), Optional.empty(), List.of());

    public Subject {
        types = List.copyOf(types);
        alterationTypes = List.copyOf(alterationTypes);
        if (!types.isEmpty() && typePattern.isPresent()) {
            throw new IllegalArgumentException("types and a pattern of types exclude each other");
        }
    }

    /** Whether an entity is selected, by id and type. */
    public boolean covers(String id, String type) {
        boolean ofType = types.isEmpty()
                ? typePattern.map(pattern -> found(pattern, type)).orElse(true)
                : types.contains(type);
        return ofType && found(idPattern, id);
    }

    private static boolean found(String regex, String text) {
        return Pattern.compile(regex).matcher(text).find();
    }

    /** The member {@code subject} of a subscription. */
    ObjectNode json() {
        ObjectNode subject = JsonNodeFactory.instance.objectNode();
        ArrayNode entities = subject.putArray("entities");
        if (types.isEmpty()) {
            ObjectNode one = entities.addObject().put("idPattern", idPattern);
            typePattern.ifPresent(pattern -> one.put("typePattern", pattern));
        }
        types.forEach(type -> entities.addObject().put("idPattern", idPattern).put("type", type));
        if (!alterationTypes.isEmpty()) {
            alterationTypes.forEach(subject.putObject("condition").putArray("alterationTypes")::add);
        }
        return subject;
    }
}
