package io.furrow.control.domain;

import java.util.List;

/** Gives the domain manager access to the missions of a domain. */
public interface DomainMissions {
    List<String> in(String domain);

    /** Names of those that are starting, running or stopping. */
    List<String> activeIn(String domain);

    /** Removes a mission with its devices, even if it runs: hosts stop devices that are removed. */
    void remove(String mission);
}
