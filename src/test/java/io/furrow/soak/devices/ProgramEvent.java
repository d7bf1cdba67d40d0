package io.furrow.soak.devices;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What the program of a device did or met.
 *
 * @param at epoch ms
 * @param kind {@code connected}, {@code refused}, {@code cut}, {@code asked} or {@code sent}
 * @param json the rest: the user; of {@code sent} the time, value and position that it told
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

    /** The time that a measure bears, epoch ms. */
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
