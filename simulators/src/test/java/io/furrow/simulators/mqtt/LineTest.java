package io.furrow.simulators.mqtt;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class LineTest {
    @Test
    void sendsAgainWhatABrokerDroppedThoughTheConnectionHolds() throws Exception {
        try (ForgetfulBroker broker = new ForgetfulBroker(false)) {
            Line.Plan plan =
                    new Line.Plan(new MqttAccess.Login("farmer", "plough"), "line", List.of("/k/d/cmd"), 10, 1000);
            try (Line line = Line.open(new MqttAccess(broker.uri(), null, 1), plan, (topic, payload) -> {})) {
                line.send("/k/d/attrs", "1".getBytes(StandardCharsets.UTF_8));
                line.send("/k/d/attrs", "2".getBytes(StandardCharsets.UTF_8));

                await().atMost(Duration.ofSeconds(60)).until(() -> {
                    line.push();
                    return line.open() == 0;
                });

                assertThat(broker.taken()).startsWith("2").endsWith("1");
                assertThat(line.acknowledged()).isEqualTo(2);
            }
        }
    }

    /** As an embedded broker does that is not ready for the subscription though it has accepted the connection. */
    @Test
    void getsOverAConnectionThatIsCutAtTheSubscriptionWithoutAWarning() throws Exception {
        Warnings warnings = Warnings.record(LineTest.class.getPackageName());
        try (ForgetfulBroker broker = new ForgetfulBroker(true)) {
            Line.Plan plan =
                    new Line.Plan(new MqttAccess.Login("farmer", "plough"), "line", List.of("/k/d/cmd"), 10, 1000);
            try (Line line = Line.open(new MqttAccess(broker.uri(), null, 1), plan, (topic, payload) -> {})) {
                line.send("/k/d/attrs", "1".getBytes(StandardCharsets.UTF_8));

                await().until(() -> {
                    line.push();
                    return line.open() == 0;
                });

                assertThat(broker.taken()).containsExactly("1");
            }
        } finally {
            warnings.close();
        }
        assertThat(warnings.messages()).isEmpty();
    }
}
