package io.furrow.cli.time;

import java.time.Duration;
import java.time.Instant;
import java.util.Map;

import picocli.CommandLine.Option;

/** The options {@code --since} and {@code --to} of lists. */
public final class TimeRangeOptions {
    @Option(
            names = {"--since", "--from"},
            paramLabel = "TIME",
            description = "Only those not before this time, " + TimeConverter.FORMS)
    private Instant from;

    @Option(names = "--to", paramLabel = "TIME", description = "Only those before this time.")
    private Instant to;

    /** Whether one of them is given. */
    public boolean isGiven() {
        return from != null || to != null;
    }

    /** Adds {@code from} and {@code to} to the parameters of a request. */
    public void addTo(Map<String, Object> query) {
        query.put("from", from);
        query.put("to", to);
    }

    /** The same, from some time ago on if neither is given. */
    public void addTo(Map<String, Object> query, Duration byDefault) {
        addTo(query);
        if (!isGiven()) {
            query.put("from", Instant.now().minus(byDefault));
        }
    }

    /** Whether there is nothing in it before a time. */
    public boolean beginsAfter(Instant time) {
        return from != null && time.isBefore(from);
    }

    public boolean contains(Instant time) {
        return !beginsAfter(time) && (to == null || time.isBefore(to));
    }
}
