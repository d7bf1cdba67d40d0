package io.furrow.mission.export;

import java.io.IOException;
import java.time.Instant;
import java.util.Arrays;

import com.fasterxml.jackson.core.JsonGenerator;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.position.Position;

/**
 * The positions of one entity in the order of their times; 24 bytes each. Where the way from one to the next leads over the
 * antimeridian, it has two more, one on each side, between which the line is cut (RFC 7946, 3.1.9).
 */
final class Track {
    /** Degrees from a place to the one opposite. */
    private static final double HALF = 180;

    private final String entityId;
    private final FiwareScope scope;
    private String type = "";
    private long[] times = new long[16];
    private double[] places = new double[32];
    private int size;
    private long reported;
    private boolean moved;
    private boolean cut;

    Track(String entityId, FiwareScope scope) {
        this.entityId = entityId;
        this.scope = scope;
    }

    /** @param entityType the last stands */
    void add(long time, Position position, String entityType) {
        type = entityType;
        reported++;
        moved |= size > 0 && !isAt(size - 1, position);
        boolean rests = size > 1 && isAt(size - 1, position) && isAt(size - 2, position);
        if (rests) {
            times[size - 1] = time;
            return;
        }
        double way = size == 0 ? 0 : position.longitude() - places[2 * size - 2];
        if (Math.abs(way) > HALF) {
            cut(time, position, way);
        }
        append(time, position.longitude(), position.latitude());
    }

    /** @param way eastward to the position, less than −180 degrees or more than 180 */
    private void cut(long time, Position position, double way) {
        cut = true;
        double side = -Math.signum(way) * HALF;
        double share = (side - places[2 * size - 2]) / (way - Math.signum(way) * 2 * HALF);
        double latitude = places[2 * size - 1] + share * (position.latitude() - places[2 * size - 1]);
        long at = times[size - 1] + Math.round(share * (time - times[size - 1]));
        append(at, side, latitude);
        append(at, -side, latitude);
    }

    private void append(long time, double longitude, double latitude) {
        if (size == times.length) {
            times = Arrays.copyOf(times, 2 * size);
            places = Arrays.copyOf(places, 4 * size);
        }
        times[size] = time;
        places[2 * size] = longitude;
        places[2 * size + 1] = latitude;
        size++;
    }

    private boolean isAt(int index, Position position) {
        return places[2 * index] == position.longitude() && places[2 * index + 1] == position.latitude();
    }

    void write(String mission, JsonGenerator json) throws IOException {
        json.writeStartObject();
        json.writeStringField("type", "Feature");
        json.writeObjectFieldStart("geometry");
        String line = cut ? "MultiLineString" : "LineString";
        json.writeStringField("type", moved ? line : "Point");
        json.writeFieldName("coordinates");
        if (moved) {
            writeLine(json, i -> writePlace(i, json));
        } else {
            writePlace(0, json);
        }
        json.writeEndObject();
        writeProperties(mission, json);
        json.writeEndObject();
    }

    private interface OfPlace {
        void write(int index) throws IOException;
    }

    /** As an array, of one array for each part where the line is cut. */
    private void writeLine(JsonGenerator json, OfPlace each) throws IOException {
        json.writeStartArray();
        if (cut) {
            json.writeStartArray();
        }
        for (int i = 0; i < size; i++) {
            if (i > 0 && Math.abs(places[2 * i] - places[2 * i - 2]) > HALF) {
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

    private void writePlace(int index, JsonGenerator json) throws IOException {
        json.writeStartArray();
        json.writeNumber(places[2 * index]);
        json.writeNumber(places[2 * index + 1]);
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
