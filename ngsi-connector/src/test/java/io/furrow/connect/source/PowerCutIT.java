package io.furrow.connect.source;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.embedded.FreePort;
import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A broker without replicas whose disk is, after a power cut, as it was at some earlier moment, each topic at another. */
@Tag("full")
class PowerCutIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);
    private static final String NAME = "ngsi-source";

    private final List<String> answered = new ArrayList<>();

    @Test
    void hasEveryNotificationThatWasAnsweredThoughTheTopicLostItsEnd(@TempDir Path directory) throws Exception {
        int port = FreePort.orFree(0);
        SourceOnConnect source = new SourceOnConnect(port);
        try (ConnectRig rig = ConnectRig.start(directory)) {
            rig.createTopic(new NewTopic("data.raw", 2, (short) 1));
            Map<String, String> options = Map.of(
                    "listen.port", Integer.toString(port), "admin.override.bootstrap.servers", rig.bootstrapServers());
            rig.create(NAME, options);
            notify(source, "first", 20);
            awaitAll(rig);
            rig.stopKafka();
            copy("data.raw-", directory.resolve("kafka"), directory.resolve("earlier"));
            rig.startKafka();
            notify(source, "second", 20);
            awaitAll(rig);
            await("the offset store knows of all")
                    .atMost(TIMEOUT)
                    .until(() -> rig.ask("GET", "/connectors/" + NAME + "/offsets", "")
                            .body()
                            .contains("{\"record\":" + answered.size() + "}"));

            rig.stopKafka();
            copy("data.raw-", directory.resolve("earlier"), directory.resolve("kafka"));
            rig.startKafka();
            await().atMost(TIMEOUT)
                    .until(() -> rig.ask("POST", "/connectors/" + NAME + "/restart?includeTasks=true", "")
                                    .statusCode()
                            == 202);

            awaitAll(rig);
        }
    }

    private void awaitAll(ConnectRig rig) {
        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "data.raw")) {
            await().atMost(TIMEOUT)
                    .untilAsserted(() -> assertThat(reader.atLeast(1))
                            .extracting(ConsumerRecord::key)
                            .containsAll(answered));
        }
    }

    private void notify(SourceOnConnect source, String name, int number) {
        for (int i = 0; i < number; i++) {
            String id = name + i;
            await().atMost(TIMEOUT).until(() -> source.post(id) == 200);
            answered.add(id);
        }
    }

    private static void copy(String prefix, Path from, Path to) throws IOException {
        for (Path partition : Folders.list(from).stream()
                .filter(each -> each.getFileName().toString().startsWith(prefix))
                .toList()) {
            Path copy = Files.createDirectories(to.resolve(partition.getFileName()));
            for (Path file : Folders.list(copy)) {
                Files.delete(file);
            }
            for (Path file : Folders.list(partition)) {
                Files.copy(file, copy.resolve(file.getFileName()), StandardCopyOption.REPLACE_EXISTING);
            }
        }
    }
}
