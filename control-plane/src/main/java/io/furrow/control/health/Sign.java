package io.furrow.control.health;

/**
 * What those who read the reports of devices tell those who keep their health.
 *
 * @param id of the entity; empty in a pulse, which says no more than that reports arrive
 * @param type of the entity
 * @param silent whether nothing was heard for too long; false for a sign of life
 * @param heard when it was last heard of, epoch ms, by the clock of the control plane
 * @param reported event time of that, epoch ms
 * @param battery 0 to 1; null where it never said
 * @param off whether it said that it is switched off
 */
record Sign(String id, String type, boolean silent, long heard, long reported, Double battery, boolean off) {
    /** The key of a pulse; no device has it, so that readers of earlier versions pass over it. */
    static final String PULSE_KEY = "";

    /** Some device reported. @param heard when, epoch ms */
    static Sign pulse(long heard) {
        return new Sign("", null, false, heard, heard, null, false);
    }

    boolean isPulse() {
        return id.isEmpty();
    }
}
