package io.furrow.simulators.fiware;

import java.util.Map;
import java.util.Optional;

/**
 * What a request says of one entity.
 *
 * @param type empty where the request leaves it open
 * @param attributes in the order of the request
 */
record EntityUpdate(String id, Optional<String> type, Map<String, AttributeInput> attributes) {
    /** The type that a new entity gets where none is given. */
    static final String DEFAULT_TYPE = "Thing";

    /** As Orion's errors name it: with its type where the request gives one. */
    String label() {
        return type.map(given -> id + "/" + given).orElse(id);
    }

    /** What an update does with the attributes that it names. */
    enum Action {
        APPEND,
        APPEND_STRICT,
        UPDATE,
        REPLACE,
        DELETE;

        static Action of(String text) throws NgsiError {
            return switch (text) {
                case "append", "APPEND" -> APPEND;
                case "appendStrict", "APPEND_STRICT" -> APPEND_STRICT;
                case "update", "UPDATE" -> UPDATE;
                case "replace", "REPLACE" -> REPLACE;
                case "delete", "DELETE" -> DELETE;
                default ->
                    throw NgsiError.badRequest("invalid update action type: right ones are: append, appendStric,"
                            + " delete, replace, update"); // spelled as Orion does
            };
        }
    }

    /**
     * How an update is done.
     *
     * @param forced notify also where nothing changed ({@code options=forcedUpdate})
     * @param overrideMetadata metadata that the request does not name go ({@code options=overrideMetadata})
     */
    record Options(boolean forced, boolean overrideMetadata) {
        static final Options NONE = new Options(false, false);
    }
}
