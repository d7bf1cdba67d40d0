package io.furrow.simulators.device;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.HashMap;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.PositionReading;
import io.furrow.simulators.fiware.FiwareSettings;
import io.furrow.simulators.fiware.FiwareStandIn;

import static org.assertj.core.api.Assertions.assertThat;

class DemoFarmTest {
    @Test
    void appearsInTheContextBrokerWithEveryDevicesMissionAndPlace() throws Exception {
        try (EmbeddedMqtt mqtt = EmbeddedMqtt.start(Map.of("farmer", "plough"))) {
            Awaitility.await().until(() -> mqtt.uri().getPort() > 0);
            try (FiwareStandIn fiware = FiwareStandIn.start(new FiwareSettings(0, 0, mqtt.uri(), "farmer", "plough"));
                    Fleet fleet = Fleet.start(settings(mqtt, fiware), Scenario.demo())) {
                Awaitility.await().untilAsserted(() -> {
                    assertThat(fleet.reports()).isPositive();
                    Map<String, Entity> seen = entities(fiware.contextBroker());
                    for (Scenario.Assignment device : Scenario.demo().assignments()) {
                        Entity entity = seen.get(device.device().entity());
                        assertThat(entity).as(device.device().id()).isNotNull();
                        assertThat(entity.text("Domain")).contains(device.domain());
                        assertThat(entity.text("Mission")).contains(device.mission());
                        assertThat(entity.number("Time")).isPresent();
                        assertThat(PositionReading.of(entity).usable()).isPresent();
                    }
                    assertThat(seen.get("urn:ngsi-ld:Thermometer:4").number("Temperature"))
                            .contains(60d);
                    assertThat(seen.get("urn:ngsi-ld:Camera:1").text("Image")).isPresent();
                });
            }
        }
    }

    private static FleetSettings settings(EmbeddedMqtt mqtt, FiwareStandIn fiware) {
        return new FleetSettings(
                fiware.contextBroker(), fiware.iotAgent(), mqtt.uri(), "farmer", "plough", "farm", "/");
    }

    private static Map<String, Entity> entities(URI contextBroker) throws Exception {
        HttpRequest request = HttpRequest.newBuilder(URI.create(contextBroker + "/v2/entities?limit=100"))
                .header("fiware-service", "farm")
                .header("fiware-servicepath", "/")
                .build();
        Map<String, Entity> entities = new HashMap<>();
        byte[] body = HttpClient.newHttpClient()
                .send(request, HttpResponse.BodyHandlers.ofByteArray())
                .body();
        for (JsonNode json : NgsiJson.read(body)) {
            Entity entity = Entity.of(json);
            entities.put(entity.id(), entity);
        }
        return entities;
    }
}
