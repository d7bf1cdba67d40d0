package io.furrow.suite;

import java.nio.file.Path;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.dashboard.page.PageSettings;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.http.AllowedNames;
import io.furrow.launcher.suite.SuiteSettings;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class PartsThatAlreadyRunIT {
    @TempDir
    Path documents;

    @TempDir
    Path stored;

    @Test
    void usesTheGivenContextBrokerKafkaAndMongo(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory);
                EmbeddedMongo mongo = EmbeddedMongo.start(documents);
                FiwareStandIn orion = FiwareStandIn.start(FiwareSettings.httpOnly());
                RunningSuite running = RunningSuite.start(
                        stored,
                        new SuiteSettings(
                                null,
                                SuiteSettings.Fiware.of("farm"),
                                "2s",
                                null,
                                SuiteSettings.Ports.free(),
                                orion.contextBroker(),
                                kafka.bootstrapServers(),
                                mongo.uri(),
                                SuiteSettings.Farm.SIMULATED,
                                SuiteSettings.Watch.DEFAULT,
                                AllowedNames.NONE,
                                PageSettings.DEFAULT,
                                true))) {
            assertThat(running.suite().hasStandIn()).isFalse();
            assertThat(running.suite().mongo()).isEqualTo(mongo.uri());
            assertThat(running.suite().kafka().bootstrapServers()).isEqualTo(kafka.bootstrapServers());

            running.ngsi()
                    .append(
                            "{\"id\":\"probe\",\"type\":\"Probe\",\"Domain\":{\"type\":\"String\",\"value\":\"elsewhere\"}}");

            await().untilAsserted(() -> {
                try (TopicLog topic = running.topic("data.elsewhere.realtime")) {
                    assertThat(topic.of("probe")).hasSize(1);
                }
            });
        }
    }
}
