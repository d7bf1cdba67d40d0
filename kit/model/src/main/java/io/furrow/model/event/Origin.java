package io.furrow.model.event;

import java.util.Locale;

/** How Furrow received an event; the code is the value of the header {@code origin}. */
public enum Origin {
    /** An HTTP notification of the context broker. */
    NOTIFICATION,
    /** A native Kafka notification of the context broker. */
    KAFKA,
    /** A read from the context broker because a notification may have been missed. */
    REPAIR,
    /** A replay of a stored mission. */
    REPLAY;

    private final String code = name().toLowerCase(Locale.ROOT);

    public String code() {
        return code;
    }
}
