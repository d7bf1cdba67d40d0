package io.furrow.control.health;

/**
 * A message from {@link HeartbeatProcessor} to {@link DeviceHealthTracker}: a device reported or is silent.
 *
 * @param id of the entity; empty in a pulse, which only states that reports arrive
 * @param type of the entity
 * @param silent whether the device has not reported for too long; false for a heartbeat
 * @param heard when its last report was received, epoch ms, by the clock of the control plane
 * @param reported event time of that report, epoch ms
 * @param deviceTime time of that report as given by the device, even if its clock is far ahead, epoch ms; null if none
 * @param battery 0 to 1; null if never reported
 * @param percent whether the battery is a number without a unit that is in percent; false if nothing has shown this since
 *     the start; null if it is not such a number
 * @param off whether it reported that it is switched off
 */
record Heartbeat(
        String id,
        String type,
        boolean silent,
        long heard,
        long reported,
        Long deviceTime,
        Double battery,
        Boolean percent,
        boolean off) {
    /** Key of a pulse; no device has it. */
    static final String PULSE_KEY = "";

    /**
     * Creates a pulse: some device reported.
     *
     * @param heard when, epoch ms
     */
    static Heartbeat pulse(long heard) {
        return new Heartbeat("", null, false, heard, heard, null, null, null, false);
    }

    /** Returns the heartbeat that reports the device as silent. */
    Heartbeat silenced() {
        return new Heartbeat(id, type, true, heard, reported, deviceTime, battery, percent, off);
    }

    Heartbeat heardAt(long time) {
        return new Heartbeat(id, type, silent, time, reported, deviceTime, battery, percent, off);
    }

    boolean isPulse() {
        return id.isEmpty();
    }
}
