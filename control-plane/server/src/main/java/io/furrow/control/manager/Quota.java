package io.furrow.control.manager;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;

/**
 * Limits the total size of all definitions, which are held in memory.
 *
 * @param used stores the number of used bytes under its own key
 */
public record Quota(Table<Long> used, long bytes) {
    private static final String USED = "used-bytes";

    public void require(long further) throws RejectedException {
        if (further > 0 && inUse() + further > bytes) {
            throw new RejectedException(
                    ErrorCode.QUOTA_EXCEEDED,
                    "all definitions may have %d bytes together, and would have %d; delete what is not needed any more"
                            .formatted(bytes, inUse() + further));
        }
    }

    /** Changes the number of used bytes; negative to release. */
    public void use(long further) {
        used.put(USED, Math.max(0, inUse() + further));
    }

    /**
     * Replaces one value by another; either may be null.
     *
     * @throws RejectedException if the quota would be exceeded
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
