package io.furrow.simulators.scenario;

import java.io.IOException;

/** A scenario that cannot run; the message names the member, the mistake and the remedy. */
public final class InvalidScenarioException extends IOException {
    private static final long serialVersionUID = 1L;

    public InvalidScenarioException(String where, String sentence) {
        this(where, sentence, null);
    }

    InvalidScenarioException(String where, String sentence, Throwable cause) {
        super(where + ": " + sentence, cause);
    }
}
