package io.furrow.connect.source;

import java.net.URI;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class HealthPagesTest {
    @ParameterizedTest
    @ValueSource(strings = {"/health", "/metrics"})
    void answerHeadAsGetWithoutABody(String path) {
        try (NotificationRig rig = new NotificationRig()) {
            HttpResponse<String> get = rig.get(path).join();

            HttpResponse<String> head = send(rig, rig.uri(path), "HEAD");

            assertThat(head.statusCode()).isEqualTo(200);
            assertThat(head.body()).isEmpty();
            assertThat(head.headers().firstValue("Content-Type"))
                    .isEqualTo(get.headers().firstValue("Content-Type"));
            assertThat(head.headers().firstValueAsLong("Content-Length"))
                    .hasValue(get.body().length());
        }
    }

    @Test
    void areOnAPortOfTheirOwnThatTakesNoNotifications() {
        try (NotificationRig rig = new NotificationRig("health.port", "0")) {
            URI health = URI.create("http://127.0.0.1:" + rig.healthPort() + "/health");

            assertThat(rig.healthPort()).isNotEqualTo(rig.port());
            assertThat(send(rig, health, "GET").body()).contains("\"received\"");
            assertThat(send(rig, health, "HEAD").statusCode()).isEqualTo(200);
            HttpResponse<String> refused = send(rig, health.resolve("/v2/notify"), "POST");

            assertThat(refused.statusCode()).isEqualTo(405);
            assertThat(rig.recordLog.taken).isEmpty();
        }
    }

    @Test
    void areGuardedByTheAccessRuleOnThatPortToo() {
        try (NotificationRig rig = new NotificationRig("health.port", "0")) {
            URI metrics = URI.create("http://127.0.0.1:" + rig.healthPort() + "/metrics");
            HttpRequest fromAPage = HttpRequest.newBuilder(metrics)
                    .header("Origin", "http://evil.example")
                    .build();

            assertThat(rig.send(fromAPage).join().statusCode()).isEqualTo(403);
            assertThat(rig.ledger.foreign.sum()).isEqualTo(1);
        }
    }

    @Test
    void giveTheirPortBack() {
        NotificationRig rig = new NotificationRig("health.port", "0");
        int port = rig.healthPort();
        rig.close();

        try (NotificationRig next = new NotificationRig("health.port", Integer.toString(port))) {
            assertThat(next.healthPort()).isEqualTo(port);
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"8090", "8091", "8089", "65535"})
    void haveNoPortThatATaskListensOn(String port) {
        assertThatThrownBy(() -> new NgsiSourceConfig(
                        java.util.Map.of("journal.dir", "/tmp/journal", "tasks.max", "2", "health.port", port)))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining("health.port");
    }

    private static HttpResponse<String> send(NotificationRig rig, URI uri, String method) {
        return rig.send(HttpRequest.newBuilder(uri)
                        .method(
                                method,
                                method.equals("POST")
                                        ? BodyPublishers.ofString("{\"id\": \"a\"}")
                                        : BodyPublishers.noBody())
                        .build())
                .join();
    }
}
