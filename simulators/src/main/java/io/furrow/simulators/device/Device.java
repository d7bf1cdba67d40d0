package io.furrow.simulators.device;

import java.time.Instant;

/** Something that reports; all devices of a fleet share one thread, so reporting never waits for an answer. */
interface Device extends AutoCloseable {
    void report(Instant now);

    @Override
    void close();
}
