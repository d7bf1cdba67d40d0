package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonTypeName;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.StateJson;

/** What a manager is asked to do. The components of a command are members of the request. */
public sealed interface Command permits DomainCommand, MissionCommand, ReplayCommand, AlarmCommand {
    /** The member {@code command}. */
    default String verb() {
        return getClass().getAnnotation(JsonTypeName.class).value();
    }

    /** Puts the other members of the request; those that are null are left out. */
    default void describe(ObjectNode request) {
        request.setAll(StateJson.tree(this));
    }
}
