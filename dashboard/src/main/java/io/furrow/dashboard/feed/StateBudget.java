package io.furrow.dashboard.feed;

import io.furrow.dashboard.http.Problem;

/**
 * Limits the memory of all initial states, from the reading of a topic until its streams have sent the state or have
 * ended. A slow client holds its state for long; without the limit some of them would exhaust the heap. Thread-safe.
 */
public final class StateBudget {
    /** Records of a kilobyte take twice what is counted: headers, keys, objects. */
    private static final int PART_OF_HEAP = 8;

    private final long max;
    private long used;

    /** @param max in bytes */
    public StateBudget(long max) {
        this.max = max;
    }

    /** Returns a budget that has room for one state of the maximum size at least. */
    public static StateBudget ofHeap() {
        return new StateBudget(
                Math.max(InitialState.MAX_BYTES, Runtime.getRuntime().maxMemory() / PART_OF_HEAP));
    }

    /** Returns a share without any bytes, with one holder. */
    public Share share() {
        return new Share();
    }

    /** The bytes of all shares. */
    public synchronized long used() {
        return used;
    }

    /** The part of one state, until the last of its holders releases it. */
    public final class Share {
        private long bytes;
        private int holders = 1;

        private Share() {}

        /** @throws Problem if the states have no room together */
        public void resize(long newBytes, String topic) {
            synchronized (StateBudget.this) {
                if (newBytes > bytes && used + newBytes - bytes > max) {
                    throw new Problem(
                            503,
                            "too-many-states",
                            "too many streams are being sent their initial state; open that of '%s' again in some seconds"
                                    .formatted(topic));
                }
                used += newBytes - bytes;
                bytes = newBytes;
            }
        }

        void hold(int more) {
            synchronized (StateBudget.this) {
                holders += more;
            }
        }

        /** Ends one hold. */
        public void release() {
            synchronized (StateBudget.this) {
                holders--;
                if (holders == 0) {
                    used -= bytes;
                }
            }
        }
    }
}
