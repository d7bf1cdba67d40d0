package io.furrow.connect.broker;

import java.time.Duration;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.UnreadableException;

/** A context broker is unavailable or rejects a request; the message says what failed and where. */
public final class BrokerException extends Exception {
    private static final long serialVersionUID = 1L;

    private final transient Optional<Duration> retryAfter;

    private BrokerException(String message, Throwable cause, Optional<Duration> retryAfter) {
        super(message, cause);
        this.retryAfter = retryAfter;
    }

    /** The pause that the context broker requests. */
    public Optional<Duration> retryAfter() {
        return retryAfter == null ? Optional.empty() : retryAfter;
    }

    /**
     * The outcome, if it is a success.
     *
     * @param what the request, for instance {@code list subscriptions}
     */
    public static Outcome.Done success(String what, Outcome outcome) throws BrokerException {
        if (outcome instanceof Outcome.Done done) {
            return done;
        }
        if (outcome instanceof Outcome.Unavailable unavailable) {
            throw new BrokerException(
                    "cannot " + what + ": " + unavailable.reason(), unavailable.cause(), unavailable.retryAfter());
        }
        String words = outcome instanceof Outcome.Rejected rejected
                ? rejected.words()
                : outcome instanceof Outcome.WrongSetting wrong ? wrong.words() : ((Outcome.Absent) outcome).words();
        throw new BrokerException("cannot " + what + ": the context broker answered " + words, null, Optional.empty());
    }

    /** The body of a success as a list. */
    public static JsonNode list(String what, Outcome.Done done) throws BrokerException {
        try {
            return done.list();
        } catch (UnreadableException e) {
            throw new BrokerException(
                    "cannot " + what + ": the answer cannot be read: " + e.getMessage(), e, Optional.empty());
        }
    }
}
