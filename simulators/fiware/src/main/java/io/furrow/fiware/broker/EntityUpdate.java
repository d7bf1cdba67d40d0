package io.furrow.fiware.broker;

import java.util.Map;
import java.util.Optional;

import io.furrow.fiware.http.NgsiError;

/**
 * A requested update of an entity.
 *
 * @param type empty if not requested
 * @param attributes in the order of the request
 */
public record EntityUpdate(String id, Optional<String> type, Map<String, AttributeInput> attributes) {
    /** The type of a new entity without a requested one. */
    public static final String DEFAULT_TYPE = "Thing";

    /** Name in Orion's errors: with the type if requested. */
    public String label() {
        return type.map(given -> id + "/" + given).orElse(id);
    }

    /** The action of an update on its attributes. */
    public enum Action {
        APPEND,
        UPDATE,
        REPLACE,
        DELETE;

        public static Action of(String text) throws NgsiError {
            return switch (text) {
                case "append", "APPEND" -> APPEND;
                case "appendStrict", "APPEND_STRICT" -> throw NgsiError.unsupported("actionType 'appendStrict'");
                case "update", "UPDATE" -> UPDATE;
                case "replace", "REPLACE" -> REPLACE;
                case "delete", "DELETE" -> DELETE;
                default ->
                    throw NgsiError.badRequest("invalid update action type: right ones are: append, appendStric,"
                            + " delete, replace, update"); // spelled as Orion does
            };
        }
    }
}
