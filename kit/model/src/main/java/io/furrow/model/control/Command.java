package io.furrow.model.control;

import com.fasterxml.jackson.databind.node.ObjectNode;

/** What a manager is asked to do. */
public sealed interface Command permits DomainCommand, MissionCommand, ReplayCommand, AlarmCommand {
    /** The member {@code command}. */
    String verb();

    /** Puts the other members of the request; those that are null are left out. */
    void describe(ObjectNode request);
}
