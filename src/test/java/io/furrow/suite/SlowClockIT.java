package io.furrow.suite;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.stream.IntStream;
import java.util.stream.Stream;

import org.apache.kafka.clients.producer.internals.BuiltInPartitioner;
import org.awaitility.core.ConditionFactory;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A thermometer whose clock is two hours slow is alone on its partition; two robots meet on other partitions. */
@Tag("full")
class SlowClockIT {
    private static final int PARTITIONS = 4;
    private static final Duration BEHIND = Duration.ofHours(2);
    private static final String SLOW = ids("slow", 0).findFirst().orElseThrow();
    private static final List<String> ROBOTS = ids("robot", 1).limit(2).toList();

    @AutoClose
    private static RunningSuite running;

    @BeforeAll
    static void start() throws Exception {
        running = RunningSuite.start(null);
    }

    @Test
    void delaysNoEncounterAndIsReported() {
        try (TopicLog collisions = running.topic(Topics.COLLISION);
                TopicLog alarms = running.topic(Topics.ALARMS)) {
            long startedAt = System.currentTimeMillis();
            within(Duration.ofSeconds(60)).until(() -> report(2) && phases(collisions, "started") == 1);
            within(Duration.ofSeconds(30)).until(() -> report(500) && phases(collisions, "ended") == 1);
            within(Duration.ofSeconds(10)).until(() -> report(2) && phases(collisions, "started") == 2);

            within(Duration.ofSeconds(60).minusMillis(System.currentTimeMillis() - startedAt))
                    .until(() -> report(2) && isReported(alarms));
        }
    }

    private static ConditionFactory within(Duration timeout) {
        return await().pollInSameThread().pollInterval(Duration.ofMillis(500)).atMost(timeout);
    }

    private static boolean report(double meters) throws Exception {
        Instant now = Instant.now();
        String robots = entity(ROBOTS.get(0), "ROBOT", now, position(0)) + ","
                + entity(ROBOTS.get(1), "ROBOT", now, position(meters)) + ",";
        String slow = entity(SLOW, "Thermometer", now.minus(BEHIND), "\"Temperature\":{\"value\":18}");
        assertThat(running.ngsi().append(robots + slow)).isEqualTo(204);
        return true;
    }

    private static String position(double metersEast) {
        return "\"Latitude\":{\"value\":1},\"Longitude\":{\"value\":" + (1 + metersEast / 111_000) + "}";
    }

    private static String entity(String id, String type, Instant time, String attributes) {
        return "{\"id\":\"" + id + "\",\"type\":\"" + type + "\",\"Time\":{\"type\":\"DateTime\",\"value\":\"" + time
                + "\"}," + attributes + "}";
    }

    private static long phases(TopicLog collisions, String phase) throws Exception {
        long found = 0;
        for (var record : collisions.records()) {
            found += Entity.parse(record.value()).text("phase").orElse("").equals(phase) ? 1 : 0;
        }
        return found;
    }

    private static boolean isReported(TopicLog alarms) throws Exception {
        for (var record : alarms.records()) {
            var alarm = NgsiJson.mapper().readTree(record.value());
            if (alarm.path("kind").asText().equals("clock-behind")) {
                assertThat(alarm.path("text").asText()).startsWith("reports of " + SLOW + " arrive 2 h too late");
                return true;
            }
        }
        return false;
    }

    /** Ids whose records go to the first partition, or to others. */
    private static Stream<String> ids(String prefix, int from) {
        return IntStream.range(0, 100).mapToObj(i -> prefix + i).filter(id -> {
            int partition = BuiltInPartitioner.partitionForKey(id.getBytes(UTF_8), PARTITIONS);
            return from == 0 ? partition == 0 : partition >= from;
        });
    }
}
