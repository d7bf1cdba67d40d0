package io.furrow.mission.export;

import java.io.IOException;
import java.time.Instant;
import java.util.Arrays;

import com.fasterxml.jackson.core.JsonGenerator;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.position.Position;

/**
 * Collects the positions of one entity in the order of their times, 24 bytes each. A segment that crosses the
 * antimeridian gets two more positions, one on each side, and the line is cut between them (RFC 7946, 3.1.9).
 */
final class Track {
    /** Half a turn, degrees. */
    private static final double HALF = 180;

    private final String entityId;
    private final FiwareScope scope;
    private String type = "";
    private long[] times = new long[16];
    private double[] coordinates = new double[32];
    private int size;
    private long reported;
    private boolean moved;
    private boolean cut;

    Track(String entityId, FiwareScope scope) {
        this.entityId = entityId;
        this.scope = scope;
    }

    /** @param entityType the last one is written */
    void add(long time, Position position, String entityType) {
        type = entityType;
        reported++;
        moved |= size > 0 && !isAt(size - 1, position);
        boolean isStationary = size > 1 && isAt(size - 1, position) && isAt(size - 2, position);
        if (isStationary) {
            times[size - 1] = time;
            return;
        }
        double longitudeChange = size == 0 ? 0 : position.longitude() - coordinates[2 * size - 2];
        if (Math.abs(longitudeChange) > HALF) {
            cut(time, position, longitudeChange);
        }
        append(time, position.longitude(), position.latitude());
    }

    /** @param longitudeChange eastward to the position, less than −180 degrees or more than 180 */
    private void cut(long time, Position position, double longitudeChange) {
        cut = true;
        double side = -Math.signum(longitudeChange) * HALF;
        double fraction =
                (side - coordinates[2 * size - 2]) / (longitudeChange - Math.signum(longitudeChange) * 2 * HALF);
        double latitude = coordinates[2 * size - 1] + fraction * (position.latitude() - coordinates[2 * size - 1]);
        long at = times[size - 1] + Math.round(fraction * (time - times[size - 1]));
        append(at, side, latitude);
        append(at, -side, latitude);
    }

    private void append(long time, double longitude, double latitude) {
        if (size == times.length) {
            times = Arrays.copyOf(times, 2 * size);
            coordinates = Arrays.copyOf(coordinates, 4 * size);
        }
        times[size] = time;
        coordinates[2 * size] = longitude;
        coordinates[2 * size + 1] = latitude;
        size++;
    }

    private boolean isAt(int index, Position position) {
        return coordinates[2 * index] == position.longitude() && coordinates[2 * index + 1] == position.latitude();
    }

    void write(String mission, JsonGenerator json) throws IOException {
        json.writeStartObject();
        json.writeStringField("type", "Feature");
        json.writeObjectFieldStart("geometry");
        String line = cut ? "MultiLineString" : "LineString";
        json.writeStringField("type", moved ? line : "Point");
        json.writeFieldName("coordinates");
        if (moved) {
            writeLine(json, i -> writeCoordinates(i, json));
        } else {
            writeCoordinates(0, json);
        }
        json.writeEndObject();
        writeProperties(mission, json);
        json.writeEndObject();
    }

    private interface IndexWriter {
        void write(int index) throws IOException;
    }

    /** Writes an array, or an array of one array per part if the line is cut. */
    private void writeLine(JsonGenerator json, IndexWriter each) throws IOException {
        json.writeStartArray();
        if (cut) {
            json.writeStartArray();
        }
        for (int i = 0; i < size; i++) {
            if (i > 0 && Math.abs(coordinates[2 * i] - coordinates[2 * i - 2]) > HALF) {
                json.writeEndArray();
                json.writeStartArray();
            }
            each.write(i);
        }
        if (cut) {
            json.writeEndArray();
        }
        json.writeEndArray();
    }

    private void writeCoordinates(int index, JsonGenerator json) throws IOException {
        json.writeStartArray();
        json.writeNumber(coordinates[2 * index]);
        json.writeNumber(coordinates[2 * index + 1]);
        json.writeEndArray();
    }

    private void writeProperties(String mission, JsonGenerator json) throws IOException {
        json.writeObjectFieldStart("properties");
        json.writeStringField("id", entityId);
        json.writeStringField("type", type);
        json.writeStringField("mission", mission);
        json.writeStringField("service", scope.service());
        json.writeStringField("servicePath", scope.servicePath());
        json.writeNumberField("positions", reported);
        json.writeStringField("first", Instant.ofEpochMilli(times[0]).toString());
        json.writeStringField("last", Instant.ofEpochMilli(times[size - 1]).toString());
        if (moved) {
            json.writeFieldName("times");
            writeLine(json, i -> json.writeString(Instant.ofEpochMilli(times[i]).toString()));
        }
        json.writeEndObject();
    }
}
