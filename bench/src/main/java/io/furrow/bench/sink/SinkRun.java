package io.furrow.bench.sink;

/**
 * The records of a topic written by the sink.
 *
 * @param nanos from the first request to the last, or from the sink's start to its last commit if {@code entities} is 0
 * @param entities in the requests; 0 where the receiver does not count
 * @param requests updates and questions
 * @param missing entities whose newest record did not come
 * @param bareEntitiesPerSecond entities in bodies of a hundred that a server takes which only answers
 */
public record SinkRun(
        SinkPlan plan, long nanos, long entities, long requests, long missing, double bareEntitiesPerSecond) {
    /** Records per second: each is an update of an entity, whether or not it was merged with others. */
    public double updatesPerSecond() {
        return plan.records() * 1e9 / nanos;
    }
}
