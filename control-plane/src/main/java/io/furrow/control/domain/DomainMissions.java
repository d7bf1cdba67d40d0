package io.furrow.control.domain;

import java.util.List;

/** Gives the domain manager access to the missions of a domain. */
public interface DomainMissions {
    /** Names of the missions that are starting, running or stopping. */
    List<String> activeIn(String domain);

    /** Stops a mission that is starting or running; has no effect on one that is stopping already. */
    void stop(String mission, long now);
}
