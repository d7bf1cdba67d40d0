package io.furrow.analytics.collision;

/**
 * One moment in the life of an encounter of two devices; complete in itself, a reader needs no earlier record.
 *
 * @param first the device with the lesser id and where it was last seen close to the other
 * @param second the other device
 * @param distance metres between these two positions
 * @param minDistance metres, the closest so far
 * @param startTime when the encounter started, epoch milliseconds
 * @param time when this phase was reached, epoch milliseconds
 */
public record Encounter(
        Phase phase,
        PositionFix first,
        PositionFix second,
        double distance,
        double minDistance,
        long startTime,
        long time) {

    /** The pair and the start: a second pass over the same events names its encounters the same. */
    public String id() {
        return pairId() + "@" + startTime;
    }

    /** The same pair and places in another phase, or of an encounter with another start. */
    Encounter of(Phase other, double distance, double closest, long start, long time) {
        return new Encounter(other, first, second, distance, closest, start, time);
    }

    /** One text per pair, the same as of its sightings. */
    String pair() {
        return Sighting.pair(first, second);
    }

    /** 32 hexadecimal digits that stand for the pair. */
    public String pairId() {
        return PairId.of(first.identity(), second.identity());
    }
}
