package io.furrow.control.manager;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;

/**
 * Room for all definitions together, which are held in memory: how many bytes are used is remembered.
 *
 * @param used where it is remembered how much is used, under a key of its own
 */
public record Quota(Table<Long> used, long bytes) {
    private static final String USED = "used-bytes";

    /** @throws RejectedException where there is not so much room left */
    public void require(long further) throws RejectedException {
        if (further > 0 && inUse() + further > bytes) {
            throw new RejectedException(
                    ErrorCode.QUOTA_EXCEEDED,
                    "all definitions may have %d bytes together, and would have %d; delete what is not needed any more"
                            .formatted(bytes, inUse() + further));
        }
    }

    /** Uses more, or less where it is negative. */
    public void use(long further) {
        used.put(USED, Math.max(0, inUse() + further));
    }

    /**
     * Puts one value in the place of another; either may be null.
     *
     * @throws RejectedException if there is no room for it
     */
    public void replace(byte[] before, byte[] after) throws RejectedException {
        long further = (after == null ? 0 : after.length) - (before == null ? 0 : before.length);
        require(further);
        use(further);
    }

    private long inUse() {
        Long existing = used.get(USED);
        return existing == null ? 0 : existing;
    }
}
