package io.furrow.bench.http;

import java.time.Duration;

/**
 * A load of notifications.
 *
 * @param connections how many requests can be open at a time
 * @param newConnections whether each request comes over a connection of its own, as Orion does unless configured otherwise
 * @param rate requests per second that are due whether or not earlier ones were answered; 0 for as many as are answered
 * @param payloadBytes of a body
 * @param entities how many ids there are
 */
public record HttpLoadPlan(
        int connections, boolean newConnections, int rate, int payloadBytes, int entities, Duration duration) {
    /** The same for another time. */
    public HttpLoadPlan lasting(Duration other) {
        return new HttpLoadPlan(connections, newConnections, rate, payloadBytes, entities, other);
    }
}
