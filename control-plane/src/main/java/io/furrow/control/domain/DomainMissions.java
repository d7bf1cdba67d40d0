package io.furrow.control.domain;

import java.util.List;

/** The missions of a domain, as far as domains care for them. */
public interface DomainMissions {
    /** Names of those that start, run or stop. */
    List<String> activeIn(String domain);

    /** Stops one that starts or runs; one that stops already is left alone. */
    void stop(String mission, long now);
}
