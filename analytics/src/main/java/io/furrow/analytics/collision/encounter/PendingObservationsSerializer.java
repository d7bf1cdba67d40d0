package io.furrow.analytics.collision.encounter;

import io.furrow.analytics.eventtime.KeyStateSerializer;

/** Serializes a pair's pending observations and open encounter. */
public final class PendingObservationsSerializer extends KeyStateSerializer<PairObservation, OpenEncounter> {
    private static final long serialVersionUID = 1L;

    public PendingObservationsSerializer() {
        super(new PairObservationSerializer(), new OpenEncounterSerializer());
    }
}
