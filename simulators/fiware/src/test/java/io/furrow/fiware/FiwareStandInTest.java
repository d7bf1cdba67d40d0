package io.furrow.fiware;

import java.io.UncheckedIOException;
import java.net.URI;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMqtt;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class FiwareStandInTest {
    @Test
    void leavesNoThreadAndNoPortWhenItIsClosedTwice() {
        Set<Thread> before = Thread.getAllStackTraces().keySet();
        FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());
        int port = standIn.contextBroker().getPort();
        assertThat(ours(before)).isNotEmpty();

        standIn.close();
        standIn.close();

        await().untilAsserted(() -> assertThat(ours(before)).isEmpty());
        FiwareStandIn.start(new FiwareSettings(port, 0, null, null, null)).close();
    }

    @Test
    void leavesNoThreadWhenItIsClosedAfterTheMqttBroker() {
        Set<Thread> before = Thread.getAllStackTraces().keySet();
        EmbeddedMqtt mqtt = EmbeddedMqtt.start(Map.of("agent", "secret"));
        FiwareStandIn standIn = FiwareStandIn.start(new FiwareSettings(0, 0, mqtt.uri(), "agent", "secret"));
        assertThat(ours(before)).anyMatch(name -> name.startsWith("com.hivemq"));
        mqtt.close();

        standIn.close();

        await().untilAsserted(() -> assertThat(ours(before)).isEmpty());
    }

    @Test
    void reportsWhichPortIsTakenAndStartsNothing() {
        try (FiwareStandIn first = FiwareStandIn.start(FiwareSettings.httpOnly())) {
            Set<Thread> before = Thread.getAllStackTraces().keySet();
            int taken = first.contextBroker().getPort();

            assertThatThrownBy(() -> FiwareStandIn.start(new FiwareSettings(0, taken, null, null, null)))
                    .isInstanceOf(UncheckedIOException.class)
                    .hasMessageContaining("iot-agent cannot listen on 127.0.0.1:" + taken);

            await().untilAsserted(() -> assertThat(ours(before)).isEmpty());
        }
    }

    @Test
    void reportsThatTheMqttBrokerIsNotThere() {
        URI nobody = URI.create("tcp://127.0.0.1:1");

        assertThatThrownBy(() -> FiwareStandIn.start(new FiwareSettings(0, 0, nobody, null, null)))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining(nobody.toString());
    }

    @Test
    void excludesThePasswordFromItsText() {
        assertThat(new FiwareSettings(0, 0, null, "agent", "secret").toString())
                .contains("agent")
                .doesNotContain("secret");
    }

    private static Set<String> ours(Set<Thread> before) {
        return Thread.getAllStackTraces().keySet().stream()
                .filter(thread -> !before.contains(thread))
                .map(Thread::getName)
                .filter(name -> name.matches(
                        "(furrow-notifier|furrow-fiware|context-broker|iot-agent|furrow-iot|com.hivemq).*"))
                .collect(Collectors.toSet());
    }
}
