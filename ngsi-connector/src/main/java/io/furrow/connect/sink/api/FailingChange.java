package io.furrow.connect.sink.api;

import io.furrow.connect.broker.Outcome;

/**
 * A change that causes a 500 when it is written alone: a defect of the context broker with this entity, or with all.
 */
record FailingChange(Change change, Outcome.Away away) {
    private static final int INTERNAL_SERVER_ERROR = 500;

    /** Whether an answer may concern the content of the request; 502, 503 and 504 concern the server. */
    static boolean isMeant(Outcome.Away away) {
        return away.status() == INTERNAL_SERVER_ERROR;
    }
}
