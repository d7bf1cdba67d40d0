package io.furrow.simulators.mqtt;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.URI;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class MqttConnectionTest {
    @Tag("full")
    @Test
    void sendsAgainWhatABrokerDroppedThoughTheConnectionHolds() throws Exception {
        try (ForgetfulBroker broker = new ForgetfulBroker(false)) {
            MqttConnection.Plan plan = new MqttConnection.Plan(
                    new MqttAccess.Login("farmer", "plough"), "line", List.of("/k/d/cmd"), 10, 1000);
            try (MqttConnection connection =
                    MqttConnection.open(new MqttAccess(broker.uri(), null, 1), plan, (topic, payload) -> {})) {
                connection.send("/k/d/attrs", "1".getBytes(UTF_8));
                connection.send("/k/d/attrs", "2".getBytes(UTF_8));

                await().until(() -> {
                    connection.push();
                    return connection.open() == 0;
                });

                assertThat(broker.taken()).startsWith("2").endsWith("1");
                assertThat(connection.acknowledged()).isEqualTo(2);
            }
        }
    }

    /** As one does that hangs; without a limit each attempt would take a thread forever. */
    @Test
    void givesUpABrokerThatAcceptsAndReportsNothing() throws Exception {
        try (ServerSocket silent = new ServerSocket(0, 10, InetAddress.getLoopbackAddress())) {
            URI uri = URI.create("tcp://127.0.0.1:" + silent.getLocalPort());
            var plan = new MqttConnection.Plan(new MqttAccess.Login("farmer", "plough"), "line", List.of(), 10, 1000);
            CompletableFuture<MqttConnection> opening = CompletableFuture.supplyAsync(() -> {
                try {
                    return MqttConnection.open(
                            new MqttAccess(uri, null, 1), plan, (topic, payload) -> {}, Duration.ofSeconds(1));
                } catch (IOException e) {
                    throw new UncheckedIOException(e);
                }
            });
            assertThatThrownBy(() -> opening.get(1, TimeUnit.MINUTES))
                    .hasMessageContainingAll("does not answer user 'farmer'", uri.toString());
        }
    }

    /** As an embedded broker does that is not ready for the subscription though it has accepted the connection. */
    @Test
    void getsOverAConnectionThatIsCutAtTheSubscriptionWithoutAWarning() throws Exception {
        LoggedWarnings warnings = LoggedWarnings.record(MqttConnectionTest.class.getPackageName());
        try (ForgetfulBroker broker = new ForgetfulBroker(true)) {
            MqttConnection.Plan plan = new MqttConnection.Plan(
                    new MqttAccess.Login("farmer", "plough"), "line", List.of("/k/d/cmd"), 10, 1000);
            try (MqttConnection connection =
                    MqttConnection.open(new MqttAccess(broker.uri(), null, 1), plan, (topic, payload) -> {})) {
                connection.send("/k/d/attrs", "1".getBytes(UTF_8));

                await().until(() -> {
                    connection.push();
                    return connection.open() == 0;
                });

                assertThat(broker.taken()).containsExactly("1");
            }
        } finally {
            warnings.close();
        }
        assertThat(warnings.messages()).isEmpty();
    }
}
