package io.furrow.provisioner;

/** Computes the number of devices per provisioning request: divided by ten after a failed request, doubled after a successful one. */
final class BatchSize {
    /** Yields a body of about 100 kB; the agent accepts a megabyte. */
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
