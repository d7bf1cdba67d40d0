package io.furrow.connect.source;

import java.nio.file.Path;
import java.time.Duration;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.embedded.FreePort;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class NgsiSourceAwayIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);

    @Tag("full")
    @Test
    void takesNotificationsWhileKafkaIsAwayAndWritesThemWhenItIsBack(@TempDir Path directory)
            throws InterruptedException {
        int port = FreePort.orFree(0);
        SourceOnConnect source = new SourceOnConnect(port);
        try (ConnectRig rig = ConnectRig.start(directory)) {
            rig.create("ngsi-source", Map.of("listen.port", Integer.toString(port)));
            await().atMost(TIMEOUT).until(() -> source.post("before") == 200);

            rig.stopKafka();
            int whileAway = source.post("meanwhile");
            rig.startKafka();

            assertThat(whileAway).isEqualTo(200);
            await().atMost(TIMEOUT).until(() -> source.post("after") == 200);
            try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "data.raw")) {
                await().atMost(TIMEOUT)
                        .untilAsserted(() -> assertThat(reader.atLeast(3))
                                .extracting(ConsumerRecord::key)
                                .contains("before", "meanwhile", "after"));
            }
        }
    }
}
