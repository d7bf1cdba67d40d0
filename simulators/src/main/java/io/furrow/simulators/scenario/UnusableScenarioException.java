package io.furrow.simulators.scenario;

import java.io.IOException;

/** A scenario that cannot be run; the message says where in the file, what is wrong and what to do. */
public final class UnusableScenarioException extends IOException {
    private static final long serialVersionUID = 1L;

    /** @param where the member that is wrong */
    public UnusableScenarioException(String where, String sentence) {
        super(where + ": " + sentence);
    }
}
