package io.furrow.simulators.device;

import java.time.Instant;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.DoubleNode;

import io.furrow.model.ngsi.Position;

/** Measures °C as member {@code temp}. */
record Thermometer(Temperature temperature) implements Sensor {
    static Thermometer of(DevicePlan.ThermometerPlan plan) {
        return new Thermometer(
                plan.stuckAtCelsius() == null
                        ? new Temperature.Diurnal(plan.meanCelsius(), plan.id().hashCode())
                        : new Temperature.Stuck(plan.stuckAtCelsius()));
    }

    @Override
    public String entityType() {
        return "Thermometer";
    }

    @Override
    public Registration.Attribute attribute() {
        return new Registration.Attribute("temp", "Temperature", "Float");
    }

    @Override
    public JsonNode measure(Instant time, Position place) {
        return DoubleNode.valueOf(temperature.at(time));
    }
}
