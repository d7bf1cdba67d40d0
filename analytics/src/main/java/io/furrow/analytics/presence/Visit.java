package io.furrow.analytics.presence;

import io.furrow.analytics.position.PositionFix;

/**
 * A device in a field, or just out of it.
 *
 * @param field the field's id
 * @param name the field's name at the entry; empty if it has none
 * @param domain the field's domain at the entry; empty if it has none
 * @param since when the device came in, epoch ms
 * @param emitted whether the stay reached the dwell and {@code entered} was emitted
 * @param left when the device went out, epoch ms; {@link #INSIDE} while it is in
 * @param cause of the last entry or exit
 * @param fix the position at the last entry or exit
 */
public record Visit(
        String field,
        String name,
        String domain,
        long since,
        boolean emitted,
        long left,
        Cause cause,
        PositionFix fix) {
    static final long INSIDE = Long.MAX_VALUE;

    boolean isInside() {
        return left == INSIDE;
    }

    /** When the next transition is emitted unless the device goes in or out before; {@link Long#MAX_VALUE} for never. */
    long deadline(long dwell) {
        if (!isInside()) {
            return left + dwell;
        }
        return emitted ? Long.MAX_VALUE : since + dwell;
    }

    Visit leaving(long time, Cause why, PositionFix where) {
        return new Visit(field, name, domain, since, emitted, time, why, where);
    }

    Visit back() {
        return new Visit(field, name, domain, since, emitted, INSIDE, cause, fix);
    }

    Visit entered() {
        return new Visit(field, name, domain, since, true, left, cause, fix);
    }
}
