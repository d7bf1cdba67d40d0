package io.furrow.mission.export;

import java.io.IOException;
import java.io.OutputStream;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.core.JsonGenerator;

import io.furrow.mission.Recording;
import io.furrow.mission.StoredEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Position;
import io.furrow.model.ngsi.PositionReading;

/**
 * GeoJSON (RFC 7946), for maps: a feature for each entity that told a position, a LineString with {@code times} (ISO 8601, one per
 * position) of what moved, a Point with {@code first} and {@code last} of what stood still. Of positions that are told again in
 * one place the first and the last are written. Holds the tracks.
 */
public final class GeoJsonExport implements MissionExport {
    @Override
    public Exported write(String mission, Recording recording, OutputStream out, LongConsumer progress)
            throws IOException {
        TreeMap<String, Track> tracks = new TreeMap<>();
        Exported read = new ExportRun(progress).over(recording, event -> add(event, tracks));
        try (JsonGenerator json = NgsiJson.mapper().getFactory().createGenerator(out)) {
            json.disable(JsonGenerator.Feature.AUTO_CLOSE_TARGET);
            json.writeStartObject();
            json.writeStringField("type", "FeatureCollection");
            json.writeArrayFieldStart("features");
            for (Map.Entry<String, Track> track : tracks.entrySet()) {
                track.getValue().write(mission, json);
            }
            json.writeEndArray();
            json.writeEndObject();
        }
        return read;
    }

    private static Optional<String> add(StoredEvent event, Map<String, Track> tracks) {
        if (event.entity() == null) {
            return Optional.empty();
        }
        PositionReading reading = PositionReading.of(new Entity(event.entity()));
        if (reading instanceof PositionReading.Faulty faulty) {
            return Optional.of(faulty.fault());
        }
        Optional<Position> position = reading.usable();
        if (position.isPresent()) {
            FiwareScope scope = FiwareScope.of(
                    event.headers().get(HeaderNames.SERVICE), event.headers().get(HeaderNames.SERVICE_PATH));
            tracks.computeIfAbsent(scope.identity(event.entityId()), ignored -> new Track(event.entityId(), scope))
                    .add(
                            event.time(),
                            position.get(),
                            event.entity().path("type").asText("Thing"));
        }
        return Optional.empty();
    }
}
