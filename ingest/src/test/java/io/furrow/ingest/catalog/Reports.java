package io.furrow.ingest.catalog;

import java.util.HashMap;
import java.util.Map;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Events for the catalog's tests. */
final class Reports {
    static final long TIME = 1_700_000_000_000L;

    private Reports() {}

    /** A change of an entity; null as its JSON for its deletion. */
    static ReportedEvent of(String id, String mission, long time, String json) {
        byte[] value = json == null ? null : json.getBytes(UTF_8);
        TopicRecord record = new TopicRecord(
                "data.raw",
                0,
                time,
                time,
                id.getBytes(UTF_8),
                value,
                new HashMap<>(Map.of(HeaderNames.SERVICE, "farm")));
        return new ReportedEvent(id + time, "farm|/|" + id, id, "Thermometer", "north", mission, record);
    }

    static ReportedEvent thermometer(String id, String mission, long time, double degrees) {
        return of(
                id,
                mission,
                time,
                "{\"id\":\"" + id + "\",\"type\":\"Thermometer\",\"Temperature\":{\"type\":\"Float\",\"value\":"
                        + degrees + ",\"metadata\":{\"unitCode\":{\"type\":\"Text\",\"value\":\"CEL\"}}}}");
    }
}
