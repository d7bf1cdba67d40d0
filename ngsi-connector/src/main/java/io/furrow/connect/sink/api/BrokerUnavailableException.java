package io.furrow.connect.sink.api;

import io.furrow.connect.broker.Outcome;

/** The context broker is unavailable or requests a retry; changes that were already written may be written again. */
public final class BrokerUnavailableException extends Exception {
    private static final long serialVersionUID = 1L;

    private final transient Outcome.Unavailable unavailable;

    BrokerUnavailableException(Outcome.Unavailable unavailable) {
        super(unavailable.reason(), unavailable.cause());
        this.unavailable = unavailable;
    }

    public Outcome.Unavailable away() {
        return unavailable;
    }
}
