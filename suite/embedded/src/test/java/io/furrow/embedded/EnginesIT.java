package io.furrow.embedded;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class EnginesIT {
    @Test
    void continuesTheLogOfAnEarlierBroker(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory)) {
            kafka.createTopics(List.of(new NewTopic("kept", 1, (short) 1)));
        }
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory);
                Admin admin = admin(kafka)) {
            assertThat(admin.listTopics().names().get()).contains("kept");
        }
    }

    @Test
    void serveTheirRestInterfacesOnLoopback(@TempDir Path directory) throws Exception {
        Path plugins = Files.createDirectory(directory.resolve("plugins"));
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory.resolve("kafka"));
                EmbeddedConnect connect = EmbeddedConnect.start(kafka.bootstrapServers(), plugins, 0, Map.of());
                EmbeddedFlink flink = EmbeddedFlink.start(1, 0)) {
            assertThat(get(connect.uri().resolve("/connectors"))).isEqualTo("[]");
            assertThat(get(flink.webUi())).contains("Apache Flink");
            assertThat(get(flink.webUi().resolve("/overview"))).contains("\"slots-total\":1");
        }
    }

    private static Admin admin(EmbeddedKafka kafka) {
        return Admin.create(kafka.client());
    }

    private static String get(URI uri) throws Exception {
        HttpRequest request = HttpRequest.newBuilder(uri).build();
        return HttpClient.newHttpClient()
                .send(request, HttpResponse.BodyHandlers.ofString())
                .body();
    }
}
