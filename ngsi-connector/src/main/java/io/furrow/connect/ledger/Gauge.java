package io.furrow.connect.ledger;

import java.util.function.LongSupplier;

/**
 * A number of now.
 *
 * @param name in camel case, as on {@code /health}
 * @param help a sentence without its full stop: what it is, and its unit
 * @param now called by whoever shows the ledger: quick, from any thread, and without throwing
 */
public record Gauge(String name, String help, LongSupplier now) {}
