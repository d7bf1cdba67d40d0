package io.furrow.connect.sink.api;

import io.furrow.connect.broker.Outcome;

/** The context broker is unavailable or requests a retry; changes that were already written may be written again. */
public final class BrokerAwayException extends Exception {
    private static final long serialVersionUID = 1L;

    private final transient Outcome.Away away;

    BrokerAwayException(Outcome.Away away) {
        super(away.reason(), away.cause());
        this.away = away;
    }

    public Outcome.Away away() {
        return away;
    }
}
