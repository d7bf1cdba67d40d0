package io.furrow.suite;

import java.nio.file.Path;
import java.util.List;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.event.HeaderNames;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class RestartIT {
    private static final int EVENTS = 20;

    @Test
    void continuesAfterARestart(@TempDir Path stored) throws Exception {
        try (RunningSuite first = RunningSuite.start(stored)) {
            send(first, 0);
            awaitRouted(first, EVENTS);
        }
        try (RunningSuite second = RunningSuite.start(stored)) {
            assertThat(second.ngsi().entity("probe").at("/n/value").asInt())
                    .as("the context broker has stored its entities")
                    .isEqualTo(EVENTS - 1);
            send(second, EVENTS);
            List<String> ids = awaitRouted(second, 2 * EVENTS);
            assertThat(ids)
                    .as("nothing is routed twice")
                    .doesNotHaveDuplicates()
                    .hasSize(2 * EVENTS);
        }
    }

    private static void send(RunningSuite running, int from) throws Exception {
        for (int i = from; i < from + EVENTS; i++) {
            int status = running.ngsi()
                    .append("{\"id\":\"probe\",\"type\":\"Probe\",\"n\":{\"type\":\"Number\",\"value\":%d},"
                                    .formatted(i)
                            + "\"Domain\":{\"type\":\"String\",\"value\":\"kept\"}}");
            assertThat(status).isEqualTo(204);
        }
    }

    private static List<String> awaitRouted(RunningSuite running, int min) {
        try (TopicLog topic = running.topic("data.kept.realtime")) {
            await().untilAsserted(() -> assertThat(topic.records()).hasSizeGreaterThanOrEqualTo(min));
            return topic.records().stream()
                    .map(record -> TopicLog.headers(record).get(HeaderNames.CE_ID))
                    .toList();
        }
    }
}
