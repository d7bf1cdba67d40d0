package io.furrow.connect.sink.api;

import io.furrow.connect.broker.Outcome;

/**
 * A change that causes a 500 when it is written alone: a defect of the context broker with this entity, or with all.
 */
record FailingChange(EntityChange entityChange, Outcome.Unavailable unavailable) {
    private static final int INTERNAL_SERVER_ERROR = 500;

    /** Whether an answer may concern the content of the request; 502, 503 and 504 concern the server. */
    static boolean isMeant(Outcome.Unavailable unavailable) {
        return unavailable.status() == INTERNAL_SERVER_ERROR;
    }
}
