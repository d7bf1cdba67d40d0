package io.furrow.provisioner;

/** How many devices are provisioned with one request: a tenth after one that was not answered, twice as many after one that was. */
final class BatchSize {
    /** A body of some 100 kB, of the megabyte that the agent takes. */
    static final int MAX = 100;

    private static final int SHRINK = 10;

    private int current = MAX;

    int current() {
        return current;
    }

    void succeeded() {
        current = Math.min(MAX, 2 * current);
    }

    void failed() {
        current = Math.max(1, current / SHRINK);
    }
}
