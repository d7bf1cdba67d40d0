package io.furrow.simulators.mqtt;

import java.time.Duration;
import java.util.function.LongSupplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Reports outages that need attention, once each; those ended by the next attempts are not. Safe from two threads. */
final class Outage {
    private static final Logger LOG = LoggerFactory.getLogger(Outage.class);
    /** Outages longer than this are reported. */
    static final Duration LONG = Duration.ofSeconds(10);

    private final LongSupplier nanoTime;
    /** Null without an outage, and once it has been reported. */
    private volatile Long since;

    Outage(LongSupplier nanoTime) {
        this.nanoTime = nanoTime;
    }

    void begin(Object connection, String cause) {
        LOG.info("{} lost its connection and reconnects: {}", connection, cause);
        since = nanoTime.getAsLong();
    }

    void end() {
        since = null;
    }

    /** Warns of a long outage. */
    void report(Object connection) {
        if (isToBeReported()) {
            LOG.warn(
                    "{} has had no connection for {} s and keeps trying: is the broker running, and does it accept this user?",
                    connection,
                    LONG.toSeconds());
        }
    }

    /** Whether the outage is long and not reported yet. */
    boolean isToBeReported() {
        Long began = since;
        if (began == null || nanoTime.getAsLong() - began <= LONG.toNanos()) {
            return false;
        }
        since = null;
        return true;
    }
}
