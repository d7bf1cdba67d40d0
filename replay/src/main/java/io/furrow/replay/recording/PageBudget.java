package io.furrow.replay.recording;

import io.furrow.mission.PageLimits;
import io.furrow.replay.playback.ReadyEvent;
import io.furrow.replay.playback.ReadyPage;

/**
 * Bounds the heap that pages of events take of all replays of a reader together: {@value #BYTES} bytes, and {@value #MIN_PAGE_BYTES} for each
 * page beyond, or one event if that is larger. The more is held, the smaller the next page. Safe from all threads.
 */
public final class PageBudget {
    static final long BYTES = 64 * 1024 * 1024;
    static final long MIN_PAGE_BYTES = 128 * 1024;
    /** Of what is free a page takes this part: others come at the same time. */
    private static final int SHARE = 4;
    /** Bytes that an event takes beside its value: its key, its headers and its objects. */
    private static final int OVERHEAD = 1024;

    private final PageLimits max;
    private long held;

    /** @param max of any page */
    public PageBudget(PageLimits max) {
        this.max = max;
    }

    public Pages pages() {
        return new Pages();
    }

    private synchronized long reserve() {
        long bytes = Math.max(MIN_PAGE_BYTES, (BYTES - held) / SHARE);
        held += bytes;
        return bytes;
    }

    private synchronized void change(long bytes) {
        held += bytes;
    }

    synchronized long held() {
        return held;
    }

    /** Those of one replay: of the two newest something may be left to be played. Used by one thread. */
    public final class Pages {
        private long reserved;
        private long newest;
        private long before;

        /**
         * How large the next page may be, until {@link #settle}.
         *
         * @param events that are requested, at least 1
         */
        public PageLimits next(int events) {
            reserved = reserve();
            long most = Math.min(reserved / 2, max.bytes()); // as stored; as much again is overhead
            return new PageLimits((int) Math.min(Math.min(events, max.events()), reserved / 2 / OVERHEAD), (int) most);
        }

        public void add(ReadyPage page) {
            long bytes = page.events().stream().mapToLong(Pages::bytes).sum();
            change(bytes - before);
            before = newest;
            newest = bytes;
        }

        private static long bytes(ReadyEvent event) {
            byte[] value = event.record().value();
            return OVERHEAD + (value == null ? 0 : value.length);
        }

        /** The page is read, or is not. */
        public void settle() {
            change(-reserved);
            reserved = 0;
        }

        /** All have been played, or will not be. */
        public void clear() {
            change(-newest - before);
            newest = 0;
            before = 0;
        }
    }
}
