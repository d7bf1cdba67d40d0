package io.furrow.simulators.mqtt;

import java.time.Duration;
import java.util.function.LongSupplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Tells an outage that somebody must look at from one that the next attempts end. Safe from two threads. */
final class Outage {
    private static final Logger LOG = LoggerFactory.getLogger(Outage.class);
    /** After which it is reported, once. */
    static final Duration LONG = Duration.ofSeconds(10);

    private final LongSupplier nanoTime;
    /** Null while there is none, and once it has been reported. */
    private volatile Long since;

    Outage(LongSupplier nanoTime) {
        this.nanoTime = nanoTime;
    }

    /** @param connection to be named */
    void begin(Object connection, String cause) {
        LOG.info("{} lost its connection and tries again: {}", connection, cause);
        since = nanoTime.getAsLong();
    }

    void end() {
        since = null;
    }

    /** Warns of a long one. @param connection to be named */
    void report(Object connection) {
        if (isToBeReported()) {
            LOG.warn(
                    "{} has had no connection for {} s and tries on: is the broker running, and does it let this user in?",
                    connection,
                    LONG.toSeconds());
        }
    }

    /** True once in each outage that is long. */
    boolean isToBeReported() {
        Long began = since;
        if (began == null || nanoTime.getAsLong() - began <= LONG.toNanos()) {
            return false;
        }
        since = null;
        return true;
    }
}
