package io.furrow.mission.marker;

import java.io.IOException;
import java.io.OutputStream;
import java.util.List;

import io.furrow.model.ngsi.NgsiJson;

/** Writes markers to a file beside an exported mission, a {@linkplain Marker#toJson JSON object} per line. */
public final class MarkerFile {
    private static final String ENDING = ".markers.jsonl";
    private static final List<String> MISSION_ENDINGS = List.of(".gz", ".ndjson", ".jsonl");

    private MarkerFile() {}

    /** Returns {@code weeding.markers.jsonl} for {@code weeding.ndjson.gz}, in the same folder. */
    public static String beside(String missionFile) {
        String name = missionFile;
        for (String ending : MISSION_ENDINGS) {
            name = name.endsWith(ending) ? name.substring(0, name.length() - ending.length()) : name;
        }
        return name + ENDING;
    }

    /** Returns whether a file contains markers instead of events, by its name. */
    public static boolean isOne(String name) {
        return name.endsWith(ENDING) || name.endsWith(ENDING + ".gz");
    }

    /** Writes one line per marker; the stream stays open. */
    public static void write(List<Marker> markers, OutputStream out) throws IOException {
        for (Marker marker : markers) {
            out.write(NgsiJson.write(marker.toJson()));
            out.write('\n');
        }
    }
}
