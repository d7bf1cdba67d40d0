package io.furrow.analytics.collision.encounter;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;

/**
 * One moment in the life of an encounter of two devices; complete in itself, a reader needs no earlier record.
 *
 * @param first the device with the lesser id at its last position close to the other
 * @param second the other device
 * @param distance meters between these two positions
 * @param minDistance meters, the closest so far
 * @param startTime start of the encounter, epoch milliseconds
 * @param time start of this phase, epoch milliseconds
 */
public record Encounter(
        Phase phase,
        PositionFix first,
        PositionFix second,
        double distance,
        double minDistance,
        long startTime,
        long time)
        implements HasEventTime {

    /** Pair and start: a second pass over the same events yields the same id, another epoch of a replay does not. */
    public String id() {
        return id(pairId());
    }

    /** @param pairId {@link #pairId()}, which costs a digest */
    public String id(String pairId) {
        return pairId + "@" + Epochs.text(startTime);
    }

    /** The same pair and places in another phase, or with another start. */
    public Encounter of(Phase other, double distance, double closest, long start, long time) {
        return new Encounter(other, first, second, distance, closest, start, time);
    }

    public Pair pair() {
        return Pair.of(first, second);
    }

    /** The pair's id: 32 hexadecimal digits. */
    public String pairId() {
        return PairId.of(first.identity(), second.identity());
    }
}
