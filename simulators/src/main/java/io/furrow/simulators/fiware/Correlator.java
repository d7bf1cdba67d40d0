package io.furrow.simulators.fiware;

import java.util.UUID;
import java.util.concurrent.atomic.AtomicInteger;

/** What ties the notifications of one request to it: {@code Fiware-Correlator: <id>; cbnotif=<n>}, n from 1. */
final class Correlator {
    static final String HEADER = "Fiware-Correlator";

    private final String id;
    private final AtomicInteger notifications = new AtomicInteger();

    Correlator(String id) {
        this.id = id;
    }

    static Correlator fresh() {
        return new Correlator(UUID.randomUUID().toString());
    }

    String id() {
        return id;
    }

    String next() {
        return id + "; cbnotif=" + notifications.incrementAndGet();
    }
}
