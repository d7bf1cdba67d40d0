package io.furrow.mission.export;

import java.io.IOException;
import java.time.Instant;
import java.util.Arrays;

import com.fasterxml.jackson.core.JsonGenerator;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.position.Position;

/** The positions of one entity in the order of their times; 24 bytes each. */
final class Track {
    private final String entityId;
    private final FiwareScope scope;
    private String type = "";
    private long[] times = new long[16];
    private double[] places = new double[32];
    private int size;
    private long reported;
    private boolean moved;

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
        if (size == times.length) {
            times = Arrays.copyOf(times, 2 * size);
            places = Arrays.copyOf(places, 4 * size);
        }
        times[size] = time;
        places[2 * size] = position.longitude();
        places[2 * size + 1] = position.latitude();
        size++;
    }

    private boolean isAt(int index, Position position) {
        return places[2 * index] == position.longitude() && places[2 * index + 1] == position.latitude();
    }

    void write(String mission, JsonGenerator json) throws IOException {
        json.writeStartObject();
        json.writeStringField("type", "Feature");
        json.writeObjectFieldStart("geometry");
        json.writeStringField("type", moved ? "LineString" : "Point");
        if (moved) {
            json.writeArrayFieldStart("coordinates");
            for (int i = 0; i < size; i++) {
                writePlace(i, json);
            }
            json.writeEndArray();
        } else {
            json.writeFieldName("coordinates");
            writePlace(0, json);
        }
        json.writeEndObject();
        writeProperties(mission, json);
        json.writeEndObject();
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
            json.writeArrayFieldStart("times");
            for (int i = 0; i < size; i++) {
                json.writeString(Instant.ofEpochMilli(times[i]).toString());
            }
            json.writeEndArray();
        }
        json.writeEndObject();
    }
}
