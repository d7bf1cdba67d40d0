package io.furrow.connect.sink;

import io.furrow.connect.broker.Outcome;

/** The context broker cannot be reached, or says to come again; what was written before may be written again. */
final class BrokerAwayException extends Exception {
    private static final long serialVersionUID = 1L;

    private final transient Outcome.Away away;

    BrokerAwayException(Outcome.Away away) {
        super(away.reason(), away.cause());
        this.away = away;
    }

    Outcome.Away away() {
        return away;
    }
}
