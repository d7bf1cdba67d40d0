package io.furrow.model.result;

/** What the types of all result entities have in common. */
public final class ResultTypes {
    /** Begins the type and the id of each result entity; jobs skip these entities when they return through the context broker. */
    public static final String PREFIX = "Analytics:";
    /** A position that arrived too late for an analysis. */
    public static final String LATE_POSITION = PREFIX + "LatePosition";

    private ResultTypes() {}

    /** @param text type or id of an entity */
    public static boolean isResult(String text) {
        return text.startsWith(PREFIX);
    }
}
