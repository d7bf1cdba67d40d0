package io.furrow.simulators.fleet;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.Entity;

/** A report of a device. */
public sealed interface Report {
    String device();

    /** Measures for the IoT Agent, over MQTT. */
    record Measures(String device, ObjectNode json) implements Report {}

    /** An entity for the context broker, as FIROS sends it. */
    record Update(String device, Entity entity) implements Report {}
}
