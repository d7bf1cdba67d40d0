package io.furrow.mission.export;

import java.io.IOException;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.mission.marker.Marker;
import io.furrow.model.ngsi.NgsiJson;

/** Writes the markers of an MCAP file at their times to the channel {@code markers}, if there are any. */
final class McapMarkers {
    private static final String TOPIC = "markers";

    private final McapWriter file;
    private final List<Marker> markers;
    private final int channel;
    private int next;

    McapMarkers(MissionExport.Source mission, McapWriter file) {
        this.file = file;
        this.markers = mission.markers();
        if (markers.isEmpty()) {
            channel = 0;
            return;
        }
        int schema = file.schema("furrow.Marker", "jsonschema", NgsiJson.write(schema()));
        channel = file.channel(schema, TOPIC, "json", new TreeMap<>(Map.of("mission", mission.name())));
    }

    private static ObjectNode schema() {
        ObjectNode schema = McapExport.emptySchema("Marker");
        ObjectNode properties = schema.putObject("properties");
        for (String text : List.of("id", "mission", "note", "author")) {
            properties.putObject(text).put("type", "string");
        }
        for (String millis : List.of("time", "created")) {
            properties.putObject(millis).put("type", "integer").put("description", "milliseconds since 1970");
        }
        return schema;
    }

    /** Writes the markers until a time, epoch ms, inclusive. */
    void writeUntil(long time) throws IOException {
        while (next < markers.size() && markers.get(next).time() <= time) {
            Marker marker = markers.get(next++);
            file.message(channel, marker.time() * McapExport.NANOS, NgsiJson.write(marker.toJson()));
        }
    }

    /** Returns the number of markers that were not written. */
    int remaining() {
        return markers.size() - next;
    }
}
