package io.furrow.simulators.fleet;

/** What a fleet tells of its devices, on any of its threads. */
public interface FleetEvents {
    /** Takes no notice. */
    FleetEvents NONE = new FleetEvents() {
        @Override
        public void up(String device) {
            // Nobody asked.
        }

        @Override
        public void failed(String device, int attempts, String reason) {
            // Nobody asked.
        }
    };

    /** Its connection stands; of a robot: the context broker has taken what it reports. */
    void up(String device);

    /**
     * Its connection could not be opened, and is tried again.
     *
     * @param attempts so far
     * @param reason a sentence
     */
    void failed(String device, int attempts, String reason);
}
