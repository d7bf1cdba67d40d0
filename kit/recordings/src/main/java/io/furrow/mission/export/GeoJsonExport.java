package io.furrow.mission.export;

import java.io.IOException;
import java.io.OutputStream;
import java.time.Instant;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.core.JsonGenerator;

import io.furrow.mission.StoredEvent;
import io.furrow.mission.marker.Marker;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;

/**
 * Exports GeoJSON (RFC 7946) for maps: a feature for each entity with a position, as a LineString with {@code times}
 * (ISO 8601, one per position) for moving entities, or as a Point with {@code first} and {@code last} for others. Of
 * consecutive reports of one position the first and the last are written. A marker is a feature without geometry, of
 * {@code kind} {@code marker}. Holds all tracks in memory.
 */
public final class GeoJsonExport implements MissionExport {
    @Override
    public ExportResult write(Source mission, OutputStream out, LongConsumer progress) throws IOException {
        TreeMap<String, Track> tracks = new TreeMap<>();
        ExportResult read = new Exporter(progress).over(mission.recording(), event -> add(event, tracks));
        try (JsonGenerator json = NgsiJson.mapper().getFactory().createGenerator(out)) {
            json.disable(JsonGenerator.Feature.AUTO_CLOSE_TARGET);
            json.writeStartObject();
            json.writeStringField("type", "FeatureCollection");
            json.writeArrayFieldStart("features");
            for (Map.Entry<String, Track> track : tracks.entrySet()) {
                track.getValue().write(mission.name(), json);
            }
            for (Marker marker : mission.markers()) {
                write(marker, json);
            }
            json.writeEndArray();
            json.writeEndObject();
        }
        return read;
    }

    private static void write(Marker marker, JsonGenerator json) throws IOException {
        json.writeStartObject();
        json.writeStringField("type", "Feature");
        json.writeNullField("geometry");
        json.writeObjectFieldStart("properties");
        json.writeStringField("kind", "marker");
        json.writeStringField("id", marker.id());
        json.writeStringField("mission", marker.mission());
        json.writeStringField("time", Instant.ofEpochMilli(marker.time()).toString());
        json.writeStringField("note", marker.note());
        json.writeStringField("author", marker.author());
        json.writeStringField("created", Instant.ofEpochMilli(marker.created()).toString());
        json.writeEndObject();
        json.writeEndObject();
    }

    private static Optional<String> add(StoredEvent event, Map<String, Track> tracks) {
        if (event.entity() == null) {
            return Optional.empty();
        }
        PositionReading reading =
                PositionReading.of(event.headers(), () -> PositionReading.of(new Entity(event.entity())));
        if (reading instanceof PositionReading.Faulty faulty) {
            return Optional.of(faulty.fault());
        }
        Optional<Position> position = reading.usable();
        if (position.isPresent()) {
            FiwareScope scope = FiwareScope.of(event.headers());
            String type = event.entity().path("type").asText("Thing");
            tracks.computeIfAbsent(
                            scope.identity(type, event.entityId()), ignored -> new Track(event.entityId(), scope))
                    .add(event.time(), position.get(), type);
        }
        return Optional.empty();
    }
}
