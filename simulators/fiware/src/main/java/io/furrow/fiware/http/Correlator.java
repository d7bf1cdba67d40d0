package io.furrow.fiware.http;

import java.util.UUID;
import java.util.concurrent.atomic.AtomicInteger;

/** Links notifications to their request: {@code Fiware-Correlator: <id>; cbnotif=<n>}, n from 1. */
public final class Correlator {
    public static final String HEADER = "Fiware-Correlator";

    private final String id;
    private final AtomicInteger notifications = new AtomicInteger();

    Correlator(String id) {
        this.id = id;
    }

    public static Correlator fresh() {
        return new Correlator(UUID.randomUUID().toString());
    }

    String id() {
        return id;
    }

    public String next() {
        return id + "; cbnotif=" + notifications.incrementAndGet();
    }
}
