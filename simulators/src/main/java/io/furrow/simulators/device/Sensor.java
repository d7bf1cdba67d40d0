package io.furrow.simulators.device;

import java.time.Instant;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Position;

/** The measuring part of an MQTT device. */
sealed interface Sensor permits Thermometer, Camera {
    /** The NGSI type of the entity. */
    String entityType();

    /** How the measured member of a message becomes an attribute. */
    Registration.Attribute attribute();

    JsonNode measure(Instant time, Position place);
}
