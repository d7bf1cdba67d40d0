package io.furrow.fiware.broker;

import java.time.Instant;
import java.time.format.DateTimeFormatter;
import java.time.format.DateTimeFormatterBuilder;
import java.util.Optional;

import io.furrow.model.time.Instants;

/** ISO 8601 as the context broker reads it (zone and time of day are optional) and writes it (UTC, three decimals). */
public final class NgsiTime {
    private static final DateTimeFormatter WRITTEN =
            new DateTimeFormatterBuilder().appendInstant(3).toFormatter();
    private static final int DATE = "yyyy-MM-dd".length();

    private NgsiTime() {}

    public static String format(Instant time) {
        return WRITTEN.format(time);
    }

    public static Optional<Instant> parse(String text) {
        return Instants.anyForm(text.length() == DATE ? text + "T00:00" : text);
    }
}
