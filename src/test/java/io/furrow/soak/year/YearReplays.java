package io.furrow.soak.year;

import java.time.Duration;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.Until;

/** Replays a mission of each week: the replay must have each event once, and be deleted. */
final class YearReplays {
    private static final Duration TIMEOUT = Duration.ofSeconds(60);

    private final YearFarm farm;
    private String mission;
    private JsonNode replay;

    YearReplays(YearFarm farm) {
        this.farm = farm;
    }

    /** @param mission one that has ended */
    void start(String mission) {
        this.mission = mission;
        replay = farm.request(
                "POST",
                "/api/replays",
                JsonNodeFactory.instance.objectNode().put("mission", mission).put("speed", 10));
    }

    /** Checks the replay and deletes it; also deletes its topic, which the control plane would delete an hour later. */
    YearCheck playedAndDeleted(String when) throws UnreadableException, InterruptedException, ExecutionException {
        String path = "/api/replays/" + replay.path("replay").asText();
        String topic = replay.path("topic").asText();
        Until.within(
                TIMEOUT, () -> farm.up.get(path).at("/status/state").asText().equals("ended"));
        String state = farm.up.get(path).at("/status/state").asText();
        Map<String, Integer> expected = new TreeMap<>();
        Map<String, Integer> found = new TreeMap<>();
        expected.put("ended", 1);
        found.put(state, 1);
        try (ReportLog log = new ReportLog(farm.up.kafka())) {
            log.all(Topics.realtime(FarmYear.DOMAIN, mission))
                    .forEach((each, times) -> expected.put(each.toString(), 1));
            log.all(topic).forEach((each, times) -> found.put(each.toString(), times));
        }
        farm.request("DELETE", path, null);
        boolean deleted =
                Until.within(TIMEOUT, () -> Http.get(farm.up.api(path)).status() == 404);
        if (!deleted) {
            found.put("not deleted: " + path, 1);
        }
        farm.deleteTopics(topic);
        return new YearCheck(
                "replay of %s, %s".formatted(mission, when),
                "%d events, each once; deleted".formatted(expected.size() - 1),
                YearCheck.differences(expected, found));
    }
}
