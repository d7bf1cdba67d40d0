package io.furrow.model.event;

import java.util.Locale;

/** How an event came into Furrow; the code stands in the header {@code origin}. */
public enum Origin {
    /** An HTTP notification of the context broker. */
    NOTIFICATION,
    /** A native Kafka notification of the context broker. */
    KAFKA,
    /** Read from the context broker because a notification may have been missed. */
    REPAIR,
    /** Played back from a stored mission. */
    REPLAY;

    private final String code = name().toLowerCase(Locale.ROOT);

    public String code() {
        return code;
    }
}
