package io.furrow.simulators.fleet;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.Entity;

/** What a device has to say. */
public sealed interface Report {
    /** Id of the device. */
    String device();

    /** Measures that go to the IoT Agent over MQTT. */
    record Measures(String device, ObjectNode json) implements Report {}

    /** An entity that goes to the context broker directly, as FIROS sends it. */
    record Update(String device, Entity entity) implements Report {}
}
