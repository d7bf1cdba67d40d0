package io.furrow.simulators.load;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.simulators.device.FiwareServers;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.device.MqttTestClient;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class LoadFleetTest {
    @AutoClose
    private static FiwareServers ends;

    @BeforeAll
    static void start() throws IOException {
        ends = new FiwareServers();
    }

    @AfterEach
    void reset() {
        ends.reset();
    }

    @Test
    void sendsEachDevicesShareWithDistinctPayloads() throws Exception {
        LoadPlan plan = plan(20, Duration.ofMillis(50), 1_000, Duration.ofMillis(520));
        assertThat(plan.messages()).isEqualTo(200);

        try (MqttTestClient listener = new MqttTestClient(ends.settings());
                LoadFleet load = LoadFleet.start(ends.settings(), plan)) {
            load.await();
            assertThat(load.sent()).isEqualTo(200);
            assertThat(load.acknowledged()).isEqualTo(200);
            await().until(() -> listener.received().size() >= 200);

            List<MqttTestClient.Heard> received = listener.received();
            assertThat(received).hasSize(200);
            assertThat(received.stream().map(message -> payload(message.json())))
                    .doesNotHaveDuplicates()
                    .allSatisfy(text -> assertThat(text).hasSize(1_000).matches("[A-Za-z0-9.]+"));
            assertThat(received.stream().map(message -> head(message.json()))).doesNotHaveDuplicates();
            Map<String, Long> shares = received.stream()
                    .collect(Collectors.groupingBy(MqttTestClient.Heard::topic, Collectors.counting()));
            assertThat(shares).hasSize(20).containsEntry("/furrow-load/load-00007/attrs", 10L);
            assertThat(shares.values()).containsOnly(10L);
        }
    }

    @Test
    void spreadsTheDevicesOverThePeriodAndFollowsTheSchedule() throws Exception {
        LoadPlan plan = plan(10, Duration.ofMillis(200), 100, Duration.ofMillis(600));
        try (MqttTestClient listener = new MqttTestClient(ends.settings());
                LoadFleet load = LoadFleet.start(ends.settings(), plan)) {
            load.await();
            await().until(() -> listener.received().size() == 30);

            long[] times = listener.received().stream()
                    .mapToLong(message -> message.json().path("time").longValue())
                    .sorted()
                    .toArray();
            // The last is due 580 ms after the first; a busy machine may send it later, never earlier.
            assertThat(times[29] - times[0]).isBetween(540L, 5_000L);
            assertThat(times[15] - times[0]).isGreaterThanOrEqualTo(260L);
        }
    }

    @Test
    void provisionsItsDevicesInBatchesAndSinglyWhereSomeAreKnown() throws Exception {
        LoadPlan plan = plan(150, Duration.ofSeconds(10), 100, Duration.ofSeconds(10));
        ends.answer(request -> request.body().path("devices").size() == 50 ? 409 : 201);

        LoadFleet.provision(ends.settings(), plan);

        List<FiwareServers.ReceivedRequest> requested = ends.requested("/iot/devices");
        assertThat(requested.stream()
                        .map(request -> request.body().path("devices").size()))
                .hasSize(52)
                .startsWith(100, 50, 1);
        JsonNode device = requested.get(51).body().at("/devices/0");
        assertThat(device.path("device_id").textValue()).isEqualTo("load-00149");
        assertThat(device.path("attributes").findValuesAsText("name")).containsExactly("Time", "Status", "Payload");
        assertThat(device.path("static_attributes").findValuesAsText("value")).containsExactly("bench", "load");
    }

    @Test
    void holdsWhatTheBrokerIsTooSlowForAndLosesNothing() throws Exception {
        try (SlowBroker slow = new SlowBroker()) {
            LoadPlan plan = plan(1, Duration.ofMillis(1), 1_000_000, Duration.ofMillis(40));
            try (LoadFleet load = LoadFleet.start(with(slow), plan)) {
                await().until(() -> load.held() == 1);
                assertThat(load.sent()).isEqualTo(16);
                assertThat(load.acknowledged()).isZero();

                slow.acknowledge();
                load.await();
                assertThat(load.sent()).isEqualTo(40);
            }
        }
    }

    @Test
    void sendsAgainWhatWasInFlightWhenTheConnectionBroke() throws Exception {
        try (SlowBroker slow = new SlowBroker()) {
            LoadPlan plan = plan(1, Duration.ofMillis(1), 1_000_000, Duration.ofMillis(40));
            try (LoadFleet load = LoadFleet.start(with(slow), plan)) {
                await().until(() -> load.held() == 1);
                slow.hangUp();
                slow.acknowledge();

                load.await();
                assertThat(load.sent()).isEqualTo(40);
                assertThat(load.acknowledged()).isEqualTo(40);
            }
        }
    }

    @Test
    void leavesNoThreadBehindWhenItsBrokerHangs() throws Exception {
        try (SlowBroker slow = new SlowBroker()) {
            var load = LoadFleet.start(with(slow), plan(1, Duration.ofMillis(1), 1_000_000, Duration.ofMillis(40)));
            await().until(() -> load.held() == 1);
            assertThat(ofLoad()).isNotEmpty();

            load.close();

            await().untilAsserted(() -> assertThat(ofLoad()).isEmpty());
        }
    }

    @Test
    void reportsWhenItWasClosedBeforeTheEnd() throws Exception {
        LoadFleet load = LoadFleet.start(ends.settings(), plan(1, Duration.ofSeconds(1), 100, Duration.ofSeconds(100)));
        await().until(() -> load.acknowledged() == 1);
        load.close();

        assertThatThrownBy(load::await)
                .isInstanceOf(IOException.class)
                .hasMessageContaining("of 100 messages 1 were sent");
    }

    @Test
    void rejectsAPayloadThatCannotNumberTheMessages() {
        assertThatThrownBy(() -> plan(1, Duration.ofSeconds(1), 39, Duration.ofSeconds(1)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("at least 40");
    }

    private static List<String> ofLoad() {
        return Thread.getAllStackTraces().keySet().stream()
                .map(Thread::getName)
                .filter(name -> name.contains("load-gateway") || name.equals("load"))
                .toList();
    }

    private static FleetSettings with(SlowBroker broker) {
        FleetSettings ours = ends.settings();
        return new FleetSettings(ours.contextBroker(), ours.iotAgent(), broker.uri(), "farmer", "plough", "farm", "/");
    }

    private static LoadPlan plan(int devices, Duration period, int bytes, Duration duration) {
        return new LoadPlan(devices, period, bytes, duration, "bench", "load");
    }

    private static String payload(JsonNode message) {
        return message.path("payload").textValue();
    }

    /** Device, run and sequence number. */
    private static String head(JsonNode message) {
        return payload(message).substring(0, payload(message).lastIndexOf('.'));
    }
}
