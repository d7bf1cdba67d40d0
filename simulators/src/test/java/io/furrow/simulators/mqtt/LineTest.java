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
        try (ForgetfulBroker broker = new ForgetfulBroker()) {
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
}
