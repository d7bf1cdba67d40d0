package io.furrow.simulators.fiware;

import java.util.concurrent.atomic.AtomicLong;

/** Grows with every change of what a stand-in keeps, so that the same number means the same state. */
final class Revision {
    private final AtomicLong number = new AtomicLong();

    void advance() {
        number.incrementAndGet();
    }

    long current() {
        return number.get();
    }
}
