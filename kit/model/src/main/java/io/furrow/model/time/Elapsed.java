package io.furrow.model.time;

/**
 * Compares stored instants with a wall clock that may be set back. A computer that starts with its clock ahead has
 * stored instants of the future when the clock is corrected; nothing must wait until the clock reaches them.
 */
public final class Elapsed {
    private Elapsed() {}

    /**
     * Whether a time has passed since an instant; true for an instant of the future.
     *
     * @param since epoch ms
     * @param now epoch ms
     */
    public static boolean hasPassed(long millis, long since, long now) {
        return since > now || now - since >= millis;
    }
}
