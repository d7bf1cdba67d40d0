package io.furrow.soak.devices;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * An event in the program of a device.
 *
 * @param at epoch ms
 * @param kind {@code connected}, {@code refused}, {@code cut}, {@code asked} or {@code sent}
 * @param json other members: the user; for {@code sent} the time, value and position
 */
public record ProgramEvent(long at, String device, String kind, JsonNode json) {
    static ProgramEvent read(String line) {
        JsonNode json = JsonReader.read(line);
        return new ProgramEvent(
                json.path("at").asLong(),
                json.path("device").asText(),
                json.path("event").asText(),
                json);
    }

    boolean is(String other) {
        return kind.equals(other);
    }

    /** The time in a measure, epoch ms. */
    public long time() {
        return json.path("time").asLong();
    }

    public double value() {
        return json.path("value").asDouble();
    }

    public double latitude() {
        return json.at("/position/0").asDouble();
    }

    public double longitude() {
        return json.at("/position/1").asDouble();
    }
}
