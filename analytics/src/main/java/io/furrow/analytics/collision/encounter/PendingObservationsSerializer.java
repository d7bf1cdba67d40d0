package io.furrow.analytics.collision.encounter;

import io.furrow.analytics.eventtime.PendingFormat;

/** What waits and is remembered of a pair. */
public final class PendingObservationsSerializer extends PendingFormat<PairObservation, OpenEncounter> {
    private static final long serialVersionUID = 1L;

    public PendingObservationsSerializer() {
        super(new PairObservationSerializer(), new OpenEncounterSerializer());
    }
}
