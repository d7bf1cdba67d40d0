package io.furrow.dashboard.proxy;

import java.util.HashMap;
import java.util.Map;

import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.dashboard.http.Problem;

/** Limits the open streams of all clients and of each client. */
final class StreamQuota {
    private final StreamLimits limits;
    private final Map<String, Integer> ofClients = new HashMap<>();
    private int all;

    StreamQuota(StreamLimits limits) {
        this.limits = limits;
    }

    /** @throws Problem 429 or 503 if there are too many */
    synchronized void acquire(String client) {
        int own = ofClients.getOrDefault(client, 0);
        if (own >= limits.streamsOfClient()) {
            throw new Problem(429, "too-many-streams", "this client has %d streams open; close one".formatted(own));
        } else if (all >= limits.streams()) {
            throw new Problem(503, "too-many-streams", "%d streams are open; try again later".formatted(all));
        }
        ofClients.put(client, own + 1);
        all++;
    }

    synchronized void release(String client) {
        ofClients.computeIfPresent(client, (name, count) -> count == 1 ? null : count - 1);
        all--;
    }

    synchronized int open() {
        return all;
    }
}
