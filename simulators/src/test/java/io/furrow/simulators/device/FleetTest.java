package io.furrow.simulators.device;

import java.io.IOException;
import java.net.URI;
import java.time.Duration;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Position;
import io.furrow.model.ngsi.PositionReading;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;
import static org.junit.jupiter.api.Assertions.assertTimeout;

class FleetTest {
    private static final Position PLACE = new Position(40.3134, -3.4836);
    private static final Route HERE = new Route("field-1", List.of(PLACE), 0, 0);
    private static final String TOPIC = "/key/t1";

    private static FiwareEnds ends;
    private Listener listener;
    private Fleet fleet;

    @BeforeAll
    static void start() throws IOException {
        ends = new FiwareEnds();
    }

    @AfterAll
    static void stop() {
        ends.close();
    }

    @AfterEach
    void closeAll() {
        ends.reset();
        if (fleet != null) {
            fleet.close();
        }
        if (listener != null) {
            listener.close();
        }
    }

    @Test
    void isRefusedWithAWrongPasswordNamingBrokerAndUser() {
        FleetSettings settings = ends.settings("harrow");

        assertThatThrownBy(() -> Fleet.start(settings, thermometer()))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("refuses user 'farmer'")
                .hasMessageContaining(settings.mqtt().toString())
                .hasMessageNotContaining("harrow");
        assertThat(settings.toString()).doesNotContain("harrow");
    }

    @Test
    void saysWhichIotAgentDoesNotAnswer() {
        FleetSettings right = ends.settings();
        FleetSettings wrong = new FleetSettings(
                right.contextBroker(), URI.create("http://127.0.0.1:1"), right.mqtt(), "farmer", "plough", "farm", "/");

        assertThatThrownBy(() -> Fleet.start(wrong, thermometer()))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("http://127.0.0.1:1/iot/services");
    }

    @Test
    void saysWhyTheIotAgentRefuses() {
        ends.answer(request -> request.path().equals("/iot/devices") ? 400 : 201);

        assertThatThrownBy(() -> Fleet.start(ends.settings(), thermometer()))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("answers 400 to POST /iot/devices");
    }

    @Test
    void provisionsItsDevicesAsTheContractSays() throws Exception {
        fleet = Fleet.start(ends.settings(), thermometer());

        FiwareEnds.Asked group = ends.asked("/iot/services").get(0);
        assertThat(group.service()).isEqualTo("farm");
        assertThat(group.servicePath()).isEqualTo("/fields");
        assertThat(group.body().at("/services/0/apikey").textValue()).isEqualTo("key");
        assertThat(group.body().at("/services/0/resource").textValue()).isEqualTo("/iot/json");

        JsonNode device = ends.asked("/iot/devices").get(0).body().at("/devices/0");
        assertThat(device.path("device_id").textValue()).isEqualTo("t1");
        assertThat(device.path("entity_name").textValue()).isEqualTo("urn:ngsi-ld:Thermometer:1");
        assertThat(device.path("entity_type").textValue()).isEqualTo("Thermometer");
        assertThat(device.path("transport").textValue()).isEqualTo("MQTT");
        assertThat(device.path("attributes").findValuesAsText("object_id"))
                .containsExactly("temp", "stat", "time", "lat", "lon", "where");
        assertThat(device.path("attributes").findValuesAsText("name"))
                .containsExactly("Temperature", "Status", "Time", "Latitude", "Longitude", "Location");
        assertThat(device.path("static_attributes").findValuesAsText("value")).containsExactly("farm", "weeding");
        assertThat(device.path("commands").findValuesAsText("name")).containsExactly("on", "off");
    }

    @Test
    void startsAgainWhereTheAgentKnowsItsDevices() throws Exception {
        ends.answer(request -> 409);

        listen();
        fleet = Fleet.start(ends.settings(), thermometer());

        await().until(() -> !listener.heard(TOPIC + "/attrs").isEmpty());
    }

    @Test
    void reportsWhatAThermometerMeasures() throws Exception {
        long before = System.currentTimeMillis();
        listen();
        fleet = Fleet.start(ends.settings(), thermometer());

        await().until(() -> listener.heard(TOPIC + "/attrs").size() >= 3);

        JsonNode measure = listener.heard(TOPIC + "/attrs").get(0);
        assertThat(measure.fieldNames()).toIterable().containsExactly("temp", "stat", "time", "lat", "lon", "where");
        assertThat(measure.path("temp").doubleValue()).isBetween(10d, 26d);
        assertThat(measure.path("stat").booleanValue()).isTrue();
        assertThat(measure.path("time").longValue()).isBetween(before, System.currentTimeMillis());
        assertThat(measure.path("lat").doubleValue()).isEqualTo(PLACE.latitude());
        assertThat(measure.path("lon").doubleValue()).isEqualTo(PLACE.longitude());
        assertThat(measure.path("where").textValue()).isEqualTo("field-1");
        assertThat(fleet.reports()).isGreaterThanOrEqualTo(3);
    }

    @Test
    void stopsMeasuringWhenSwitchedOffAndGoesOnWhenSwitchedOn() throws Exception {
        listen();
        fleet = Fleet.start(ends.settings(), thermometer());

        await().until(() -> !listener.heard(TOPIC + "/attrs").isEmpty());

        listener.say(TOPIC + "/cmd", "{\"off\":\"\"}");
        await().until(() -> hasLast(false));
        assertThat(listener.heard(TOPIC + "/cmdexe")).singleElement().hasToString("{\"off\":\"ok\"}");
        int silent = listener.heard(TOPIC + "/attrs").size();
        long reports = fleet.reports();
        await().until(() -> fleet.reports() > reports + 10);
        assertThat(listener.heard(TOPIC + "/attrs")).hasSize(silent);

        listener.say(TOPIC + "/cmd", "{\"on\":\"\"}");
        await().until(() -> hasLast(true));
        assertThat(listener.heard(TOPIC + "/cmdexe")).last().hasToString("{\"on\":\"ok\"}");
    }

    @Test
    void answersACommandItDoesNotKnowAndOutlivesOneThatIsNoJson() throws Exception {
        listen();
        fleet = Fleet.start(ends.settings(), thermometer());

        listener.say(TOPIC + "/cmd", "off!");
        listener.say(TOPIC + "/cmd", "{\"dance\":\"\"}");

        await().until(() -> !listener.heard(TOPIC + "/cmdexe").isEmpty());
        assertThat(listener.heard(TOPIC + "/cmdexe")).singleElement().hasToString("{\"dance\":\"unknown command\"}");
    }

    @Test
    void writesItsRobotsIntoTheContextBroker() throws Exception {
        ends.answer(request -> request.path().startsWith("/v2") ? 204 : 201);
        DevicePlan robot = new DevicePlan.RobotPlan("r1", "urn:ngsi-ld:Robot:1", HERE, 20, true);

        fleet = Fleet.start(ends.settings(), scenario(robot));

        await().until(() -> ends.asked("/v2/op/update").size() >= 3);

        FiwareEnds.Asked update = ends.asked("/v2/op/update").get(0);
        assertThat(update.service()).isEqualTo("farm");
        assertThat(update.body().path("actionType").textValue()).isEqualTo("append");
        Entity entity = Entity.of(update.body().at("/entities/0"));
        assertThat(entity.id()).isEqualTo("urn:ngsi-ld:Robot:1");
        assertThat(PositionReading.of(entity).usable()).contains(PLACE);
    }

    @Test
    void goesOnReportingARobotWhoseBrokerRefusedForAWhile() throws Exception {
        ends.answer(request -> request.path().startsWith("/v2") ? 503 : 201);
        DevicePlan robot = new DevicePlan.RobotPlan("r1", "urn:ngsi-ld:Robot:1", HERE, 20, true);

        fleet = Fleet.start(ends.settings(), scenario(robot));

        await().until(() -> ends.asked("/v2/op/update").size() >= 3);
        ends.answer(request -> 204);
        int refused = ends.asked("/v2/op/update").size();
        await().until(() -> ends.asked("/v2/op/update").size() > refused + 3);
    }

    @Test
    void leavesNoThreadBehindWhenItsBrokerIsGone() throws Exception {
        try (FiwareEnds mortal = new FiwareEnds()) {
            fleet = Fleet.start(mortal.settings(), thermometer());
            mortal.stopMqtt();
            long reports = fleet.reports();
            // More than a second, in which it tries to come back.
            await().until(() -> fleet.reports() > reports + 40);
            assertThat(ofFleet()).isNotEmpty();

            fleet.close();

            await().untilAsserted(() -> assertThat(ofFleet()).isEmpty());
        }
    }

    @Test
    void comesBackWithItsMeasuresAndItsCommandsWhenTheBrokerDoes() throws Exception {
        int port;
        try (FiwareEnds mortal = new FiwareEnds()) {
            fleet = Fleet.start(mortal.settings(), thermometer());
            port = mortal.settings().mqtt().getPort();
            mortal.stopMqtt();
            long stopped = System.currentTimeMillis();
            long reports = fleet.reports();
            await().until(() -> fleet.reports() > reports + 10);

            try (EmbeddedMqtt again = EmbeddedMqtt.start(port, Map.of(FiwareEnds.USER, FiwareEnds.PASSWORD))) {
                listener = new Listener(mortal.settings());
                await().until(() -> !listener.heard(TOPIC + "/attrs").isEmpty());
                long back = System.currentTimeMillis();
                await().until(() -> {
                    listener.say(TOPIC + "/cmd", "{\"off\":\"\"}");
                    return !listener.heard(TOPIC + "/cmdexe").isEmpty();
                });

                assertThat(listener.heard(TOPIC + "/attrs"))
                        .anySatisfy(measure ->
                                assertThat(measure.path("time").longValue()).isBetween(stopped, back));
                fleet.close();
                listener.close();
                assertThat(again.uri().getPort()).isEqualTo(port);
            }
        }
    }

    @Test
    void runsTheWholeDemoAndStopsItWithinFiveSeconds() throws Exception {
        ends.answer(request -> request.path().startsWith("/v2") ? 204 : 201);
        listen();
        fleet = Fleet.start(ends.settings(), Scenario.demo());

        await().untilAsserted(() -> {
            assertThat(listener.heard().stream().map(Listener.Heard::topic).distinct())
                    .hasSize(11);
            assertThat(ends.asked("/v2/op/update").stream()
                            .map(update -> update.body().at("/entities/0/id").textValue())
                            .distinct())
                    .hasSize(3);
        });

        assertTimeout(Duration.ofSeconds(5), fleet::close);
    }

    @Test
    void leavesNoThreadBehind() throws Exception {
        fleet = Fleet.start(ends.settings(), thermometer());
        assertThat(ofFleet()).isNotEmpty();

        fleet.close();

        await().untilAsserted(() -> assertThat(ofFleet()).isEmpty());
    }

    private static List<String> ofFleet() {
        return Thread.getAllStackTraces().keySet().stream()
                .map(Thread::getName)
                .filter(name -> name.contains("t1-") || name.equals("simulated-devices"))
                .toList();
    }

    private void listen() throws Exception {
        listener = new Listener(ends.settings());
    }

    private boolean hasLast(boolean status) {
        List<JsonNode> heard = listener.heard(TOPIC + "/attrs");
        return heard.get(heard.size() - 1).path("stat").booleanValue() == status;
    }

    private static Scenario thermometer() {
        return scenario(new DevicePlan.ThermometerPlan("t1", "urn:ngsi-ld:Thermometer:1", HERE, 50, 18, null));
    }

    private static Scenario scenario(DevicePlan device) {
        Scenario.Mission mission = new Scenario.Mission("weeding", List.of(device));
        return new Scenario("key", List.of(new Scenario.Domain("farm", List.of(mission))));
    }
}
