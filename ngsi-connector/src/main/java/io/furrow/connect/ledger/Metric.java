package io.furrow.connect.ledger;

import java.util.Locale;
import java.util.function.LongSupplier;

/**
 * A counter or a gauge.
 *
 * @param name in camel case, as on {@code /health}
 * @param help a sentence without its full stop: the meaning and the unit
 * @param isCounter whether the value only grows
 * @param value the current value: fast, thread-safe, and without exceptions
 */
public record Metric(String name, String help, boolean isCounter, LongSupplier value) {
    public long now() {
        return value.getAsLong();
    }

    /** The name in lower case, its words separated. */
    String name(char separator) {
        return name.replaceAll("([A-Z])", separator + "$1").toLowerCase(Locale.ROOT);
    }
}
