package io.furrow.ingest.mission;

import java.util.HashMap;
import java.util.Map;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Events as the branch to MongoDB gets them. */
final class Events {
    static final long TIME = 1_700_000_000_000L;

    private Events() {}

    static MissionEvent reading(String mission, int number) {
        return event(
                mission,
                "event-" + number,
                TIME + number,
                "{\"id\":\"t%d\",\"type\":\"Thermometer\",\"Temperature\":{\"type\":\"Float\",\"value\":%d.25,\"metadata\":{}}}"
                        .formatted(number % 7, number % 40));
    }

    static MissionEvent event(String mission, String id, long time, String json) {
        byte[] value = json == null ? null : json.getBytes(UTF_8);
        Map<String, String> headers = new HashMap<>(Map.of(
                HeaderNames.CE_ID,
                id,
                HeaderNames.CE_SOURCE,
                "/test",
                HeaderNames.SERVICE,
                "farm",
                HeaderNames.SERVICE_PATH,
                "/",
                HeaderNames.TS_DEVICE,
                Long.toString(time),
                HeaderNames.TS_SOURCE,
                Long.toString(time + 5),
                HeaderNames.TS_INGEST,
                Long.toString(time + 9)));
        return new MissionEvent(
                "farm", mission, new TopicRecord("data.raw", 0, 7, time, "t1".getBytes(UTF_8), value, headers));
    }

    static MissionDocument document(String mission, int number) {
        return Unchecked.get(() -> ComposeDocuments.compose(reading(mission, number)));
    }
}
