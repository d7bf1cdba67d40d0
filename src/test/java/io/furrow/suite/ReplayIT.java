package io.furrow.suite;

import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

import com.fasterxml.jackson.core.type.TypeReference;
import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.mission.Cursor;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.MongoRecordings;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A stored mission is replayed: the replay has the same records as the mission's topic. */
@Tag("full")
class ReplayIT {
    private static final int REPORTS = 30;

    @Test
    void replaysTheEventsOfAMission() throws Exception {
        try (RunningSuite running = RunningSuite.start(null);
                TopicLog live = running.topic(Topics.realtime("north", "hoeing"))) {
            runMission(running, live);
            await().until(() -> stored(running, "hoeing") == live.records().size());
            awaitListed(running, "hoeing");

            JsonNode replay = running.post("/api/replays", "{\"mission\":\"hoeing\",\"speed\":\"max\"}");
            try (TopicLog played = running.topic(replay.path("topic").asText())) {
                await().until(() -> played.records().stream().anyMatch(record -> kind(record, "end")));

                assertThat(byId(played.records(), "event", HeaderNames.REPLAY_CE_ID))
                        .isEqualTo(byId(live.records(), null, HeaderNames.CE_ID))
                        .hasSizeGreaterThanOrEqualTo(REPORTS);
            }
            seeksToTheLastEvent(
                    running,
                    replay.path("replay").asText(),
                    replay.path("topic").asText());
        }
    }

    private static void seeksToTheLastEvent(RunningSuite running, String replay, String topic) throws Exception {
        String path = "/api/replays/" + replay;
        await("settled at its end")
                .until(() -> running.get(path).at("/status/settled").asBoolean());
        JsonNode rested = running.get(path);
        assertThat(rested.at("/status/state").asText()).isEqualTo("ended");
        long last = rested.at("/status/progress/to").asLong();

        running.post(path + "/seek", "{\"to\":" + last + "}");
        try (TopicLog played = running.topic(topic)) {
            await().until(() -> played.records().stream()
                    .anyMatch(record -> kind(record, "end")
                            && "1".equals(TopicLog.headers(record).get(HeaderNames.REPLAY_EPOCH))));
        }
        running.send("DELETE", path, "");
        await("removed after it was stopped")
                .until(() -> running.get("/api/replays").size() == 0);
    }

    private static void runMission(RunningSuite running, TopicLog live) throws Exception {
        running.awaitReady();
        running.post("/api/domains", "{\"domain\":\"north\"}");
        running.post("/api/missions/hoeing/start", """
                {"domain": "north", "devices": [
                  {"type": "Thermometer", "count": 3, "period": "PT0.2S", "path": [[-3.48, 40.31]]}]}
                """);
        await().until(() -> live.records().size() >= REPORTS);
        running.post("/api/missions/hoeing/stop", "{}");
        running.awaitState("hoeing", "stopped");
    }

    /** The number of stored events of a mission. */
    static long stored(RunningSuite running, String mission) throws Exception {
        Optional<Recording> recording =
                new MongoRecordings(running.suite().mongo(), MongoAccess.DATABASE).open(mission);
        if (recording.isEmpty()) {
            return 0;
        }
        try (Recording open = recording.get()) {
            return open.read(Cursor.START, new PageLimits(100_000, Integer.MAX_VALUE))
                    .events()
                    .size();
        }
    }

    /** Waits until the catalog of recordings, which is polled, lists the mission: before that a replay is rejected. */
    static void awaitListed(RunningSuite running, String mission) {
        await("listed among the recordings").until(() -> {
            List<String> listed = running.get("/api/recordings").findValuesAsText("mission");
            return listed.contains(mission);
        });
    }

    private static boolean kind(ConsumerRecord<byte[], byte[]> record, String kind) {
        return kind.equals(TopicLog.headers(record).get(HeaderNames.REPLAY_KIND));
    }

    /** Timestamp and value of each record by event id. */
    private static Map<String, String> byId(List<ConsumerRecord<byte[], byte[]>> records, String kind, String id) {
        Map<String, String> byId = new TreeMap<>();
        for (ConsumerRecord<byte[], byte[]> record : records) {
            if (kind == null || kind(record, kind)) {
                String value = record.value() == null ? "" : new String(record.value(), UTF_8);
                byId.put(TopicLog.headers(record).get(id), record.timestamp() + " " + sorted(value));
            }
        }
        return byId;
    }

    /** Serializes an entity with sorted members, so that equal entities have equal texts. */
    private static String sorted(String json) {
        return Unchecked.get(() -> json.isEmpty()
                ? ""
                : NgsiJson.mapper()
                        .readValue(json, new TypeReference<TreeMap<String, Object>>() {})
                        .toString());
    }
}
