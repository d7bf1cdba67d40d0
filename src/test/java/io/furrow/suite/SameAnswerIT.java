package io.furrow.suite;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

import com.fasterxml.jackson.core.type.TypeReference;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/**
 * Robots and thermometers of the demonstration farm as one mission: replays yield the same results as the live run, at
 * any speed.
 */
@Timeout(480)
@Tag("full")
class SameAnswerIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);
    private static final List<String> RESULTS =
            List.of(Topics.COLLISION, Topics.TEMPERATURE, Topics.PRESENCE, Topics.COVERAGE, Topics.COVERAGE_LAYER);

    @Test
    void replaysYieldTheLiveResults() throws Exception {
        try (RunningSuite running = RunningSuite.start(null);
                TopicLog live = running.topic(Topics.realtime("farm", "weeding"));
                TopicLog collisions = running.topic(Topics.COLLISION)) {
            running.awaitReady();
            running.post("/api/domains", "{\"domain\":\"farm\"}");
            // reports outside of the fields after the mission has ended, so that event time advances
            running.post("/api/domains", "{\"domain\":\"canary\"}");
            running.post("/api/missions/dummy/start", """
                    {"domain": "canary", "devices": [{"type": "Thermometer", "period": "PT1S", "path": [[-3.482, 40.3092]]}]}
                    """);
            running.post("/api/missions/weeding/start", """
                    {"domain": "farm", "devices": [
                      {"type": "Thermometer", "period": "PT1S", "path": [[-3.4836, 40.3134]]},
                      {"type": "Thermometer", "period": "PT1S", "path": [[-3.4825, 40.31325]]},
                      {"type": "Thermometer", "period": "PT1S", "path": [[-3.48355, 40.3135]]},
                      {"type": "Thermometer", "period": "PT1S", "path": [[-3.4826, 40.3133]],
                       "faults": [{"kind": "stuck", "value": 60}]},
                      {"type": "Robot", "period": "PT0.5S", "speed": 1.5, "parameters": {"start": 6, "width": 2},
                       "path": [[-3.484, 40.3128], [-3.4836, 40.3128]]},
                      {"type": "Robot", "period": "PT0.5S", "speed": 1.5, "parameters": {"start": 6, "width": 2},
                       "path": [[-3.4836, 40.31281], [-3.484, 40.31281]]}]}
                    """);
            await().atMost(TIMEOUT).until(() -> phases(collisions).contains("ended"));
            running.post("/api/missions/weeding/stop", "{}");
            running.awaitState("weeding", "stopped");

            await().atMost(TIMEOUT)
                    .until(() -> ReplayIT.stored(running, "weeding")
                            == live.records().size());
            ReplayIT.awaitListed(running, "weeding");

            List<String> topics = List.of(replay(running, "1"), replay(running, "10"), replay(running, "\"max\""));
            for (String result : RESULTS) {
                for (String topic : topics) {
                    // windows and encounters that are open in the live run close as its event time advances
                    await().atMost(TIMEOUT)
                            .untilAsserted(() -> assertSame(
                                    topic,
                                    answers(running, result, 0),
                                    answers(running, Topics.resultOf(topic, result), 0)));
                }
            }
            yieldsTheSameResultsAfterASeek(running, topics.get(2));
        }
    }

    /** Seeks from the end to the first event, which begins an epoch with its own results. */
    private static void yieldsTheSameResultsAfterASeek(RunningSuite running, String topic) throws Exception {
        String path = "/api/replays/weeding" + topic.substring(topic.lastIndexOf('.'));
        JsonNode replay = running.get(path);
        long first = replay.at("/status/progress/from").asLong();
        running.post(path + "/seek", "{\"to\":" + first + "}");
        for (String result : RESULTS) {
            await().atMost(TIMEOUT)
                    .untilAsserted(() -> assertSame(
                            topic + " after a seek",
                            answers(running, result, 0),
                            answers(running, Topics.resultOf(topic, result), 1)));
        }
    }

    private static void assertSame(String topic, Set<String> live, Set<String> replayed) {
        Set<String> missing = new TreeSet<>(live);
        missing.removeAll(replayed);
        Set<String> added = new TreeSet<>(replayed);
        added.removeAll(live);
        // a silent device leaves its field after five minutes, which the live run has not reached yet
        long now = System.currentTimeMillis();
        added.removeIf(answer -> Long.parseLong(answer.substring(0, answer.indexOf(' '))) > now);
        assertThat(live).isNotEmpty();
        assertThat(missing).as("of %d only live, not on %s", live.size(), topic).isEmpty();
        assertThat(added).as("only on %s", topic).isEmpty();
    }

    private static List<String> phases(TopicLog collisions) {
        return collisions.records().stream()
                .map(record -> entity(record).at("/phase/value").asText())
                .toList();
    }

    private static String replay(RunningSuite running, String speed) throws Exception {
        JsonNode answer = running.post("/api/replays", """
                {"mission": "weeding", "speed": %s, "analytics": ["collision", "temperature", "presence", "coverage"]}
                """.formatted(speed));
        assertThat(answer.path("topic").asText()).as(answer.toString()).isNotEmpty();
        return answer.path("topic").asText();
    }

    /** Timestamp, key and attributes of each result of an epoch, sorted. */
    private static Set<String> answers(RunningSuite running, String topic, int epoch) {
        try (TopicLog log = running.topic(topic)) {
            Set<String> answers = new TreeSet<>();
            for (ConsumerRecord<byte[], byte[]> record : log.records()) {
                Map<String, String> headers = TopicLog.headers(record);
                if (!headers.getOrDefault(HeaderNames.REPLAY_EPOCH, "0").equals(Integer.toString(epoch))) {
                    continue;
                }
                Map<String, Object> entity = NgsiJson.mapper()
                        .convertValue(
                                withoutEpoch(entity(record), epoch), new TypeReference<TreeMap<String, Object>>() {});
                String key = new String(record.key(), UTF_8);
                answers.add(record.timestamp() + " " + key + " " + entity);
            }
            return answers;
        }
    }

    /** Removes the epoch's suffix from the ids of encounters and stays. */
    private static JsonNode withoutEpoch(JsonNode entity, int epoch) {
        for (JsonNode attribute : entity) {
            String value = attribute.path("value").asText();
            if (epoch > 0 && value.endsWith(":" + epoch)) {
                ((ObjectNode) attribute).put("value", value.substring(0, value.lastIndexOf(':')));
            }
        }
        return entity;
    }

    private static JsonNode entity(ConsumerRecord<byte[], byte[]> record) {
        return Unchecked.get(() -> NgsiJson.read(record.value()));
    }
}
