package io.furrow.ingest.image;

import java.util.Base64;
import java.util.HashMap;
import java.util.Map;

import io.furrow.files.RandomPicture;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

/** Images and the events of cameras for tests; the same seed, the same bytes. */
public final class Pictures {
    public static final long TIME = 1_700_000_000_123L;

    private Pictures() {}

    public static byte[] png(int seed) {
        return RandomPicture.of("png", seed);
    }

    static byte[] jpeg(int seed) {
        return RandomPicture.of("jpg", seed);
    }

    public static String base64(byte[] bytes) {
        return Base64.getEncoder().encodeToString(bytes);
    }

    static ReportedEvent camera(String id, long time, byte[] image) {
        return event(id, time, Entity.builder(id, "Camera").text("Image", base64(image)));
    }

    static ReportedEvent thermometer(String id, long time) {
        return event(id, time, Entity.builder(id, "Thermometer").number("Temperature", 21.5));
    }

    static ReportedEvent event(String id, long time, EntityBuilder entity) {
        return event(id, time, entity.build().toBytes());
    }

    static ReportedEvent event(String id, long time, byte[] value) {
        String eventId = id + "@" + time;
        TopicRecord record = new TopicRecord(
                "data.raw",
                0,
                7,
                time,
                id.getBytes(java.nio.charset.StandardCharsets.UTF_8),
                value,
                new HashMap<>(Map.of(HeaderNames.CE_ID, eventId, HeaderNames.SERVICE, "farm")));
        return new ReportedEvent(eventId, "farm|/|" + id, id, "Camera", "north", "weeding", record);
    }
}
