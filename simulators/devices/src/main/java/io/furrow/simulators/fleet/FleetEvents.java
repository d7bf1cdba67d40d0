package io.furrow.simulators.fleet;

/** Receives connection events of devices, on any thread of the fleet; ignores them by default. */
public interface FleetEvents {
    /** The device is connected; for a robot: the context broker has accepted its first update. */
    default void up(String device) {}

    /**
     * A connection attempt failed and is retried.
     *
     * @param attempts so far
     * @param reason a sentence
     */
    default void failed(String device, int attempts, String reason) {}
}
