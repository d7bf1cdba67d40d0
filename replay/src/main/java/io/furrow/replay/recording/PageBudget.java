package io.furrow.replay.recording;

import io.furrow.mission.PageLimits;
import io.furrow.replay.playback.ReadyEvent;
import io.furrow.replay.playback.ReadyPage;

/**
 * Bounds the heap of the pages of all replays of a reader: {@value #BYTES} bytes, plus {@value #MIN_PAGE_BYTES} or one
 * larger event for each further page. The more heap is in use, the smaller is the next page. Thread-safe.
 */
public final class PageBudget {
    static final long BYTES = 64 * 1024 * 1024;
    static final long MIN_PAGE_BYTES = 128 * 1024;
    /** A page takes this fraction of the free bytes, because others are read at the same time. */
    private static final int SHARE = 4;
    /** Bytes of an event in addition to its value: key, headers and objects. */
    private static final int OVERHEAD = 1024;

    private final PageLimits max;
    private long used;

    /** @param max limits of each page */
    public PageBudget(PageLimits max) {
        this.max = max;
    }

    public Pages pages() {
        return new Pages();
    }

    private synchronized long reserve() {
        long bytes = Math.max(MIN_PAGE_BYTES, (BYTES - used) / SHARE);
        used += bytes;
        return bytes;
    }

    private synchronized void change(long bytes) {
        used += bytes;
    }

    synchronized long used() {
        return used;
    }

    /** The pages of one replay; the two newest may be partly unplayed. Used by one thread. */
    public final class Pages {
        private long reserved;
        private long newest;
        private long before;

        /**
         * Reserves the next page until {@link #settle} and returns its limits.
         *
         * @param events requested number, at least 1
         */
        public PageLimits next(int events) {
            reserved = reserve();
            long maxBytes = Math.min(reserved / 2, max.bytes()); // bytes of stored values; the other half is overhead
            return new PageLimits(
                    (int) Math.min(Math.min(events, max.events()), reserved / 2 / OVERHEAD), (int) maxBytes);
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

        /** Releases the reservation after a page was read or could not be read. */
        public void settle() {
            change(-reserved);
            reserved = 0;
        }

        /** Releases all pages. */
        public void clear() {
            change(-newest - before);
            newest = 0;
            before = 0;
        }
    }
}
