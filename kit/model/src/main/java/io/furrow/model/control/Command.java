package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonTypeName;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.StateJson;

/** A command to a manager. Its components are members of the request. */
public sealed interface Command permits DomainCommand, MissionCommand, ReplayCommand, AlarmCommand {
    /** Returns the member {@code command}. */
    default String verb() {
        return getClass().getAnnotation(JsonTypeName.class).value();
    }

    /** Puts the other members of the request except nulls. */
    default void describe(ObjectNode request) {
        request.setAll(StateJson.tree(this));
    }
}
