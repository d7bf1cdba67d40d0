package io.furrow.model.result;

/** Common parts of the types of result entities. */
public final class ResultTypes {
    /** Prefix of types and ids of result entities, which jobs skip when they return through the context broker. */
    public static final String PREFIX = "Analytics:";
    /** Type for a position that arrived too late for an analysis. */
    public static final String LATE_POSITION = PREFIX + "LatePosition";

    private ResultTypes() {}

    /** @param text type or id of an entity */
    public static boolean isResult(String text) {
        return text.startsWith(PREFIX);
    }
}
