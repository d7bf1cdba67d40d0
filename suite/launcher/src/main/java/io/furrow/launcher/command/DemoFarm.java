package io.furrow.launcher.command;

import java.io.IOException;
import java.io.InputStream;
import java.net.URI;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RejectedException;
import io.furrow.model.ngsi.NgsiJson;

/** Creates and starts the domains, templates and missions of the demonstration farm through the REST API. */
public final class DemoFarm {
    private static final String FILE = "/io/furrow/simulators/demo/missions.json";
    private static final Set<String> ACTIVE = Set.of("starting", "running", "stopping");
    private static final String TEMPLATE = "template";
    private static final String DOMAIN = "domain";
    private static final String MISSION = "mission";

    private final ControlApi api;

    private DemoFarm(ControlApi api) {
        this.api = api;
    }

    /**
     * Creates what is missing, and starts missions that do not run; existing ones stay.
     *
     * @param control base of the control plane's REST API
     * @throws ControlPlaneException if it is unavailable or refuses
     */
    public static void start(URI control) throws IOException {
        DemoFarm farm = new DemoFarm(new ControlApi(control, null));
        JsonNode desired;
        try (InputStream json = FiwareStandIn.class.getResourceAsStream(FILE)) {
            desired = NgsiJson.mapper().readTree(json);
        }
        desired.path("domains").forEach(farm::domain);
        desired.path("templates").forEach(farm::template);
        desired.path("missions").forEach(farm::mission);
    }

    private void domain(JsonNode domain) {
        if (!has("/api/domains", DOMAIN, domain)) {
            api.send("POST", "/api/domains", domain);
        }
    }

    /** Creates the template, or a further version if it has changed. */
    private void template(JsonNode template) {
        String name = template.path(TEMPLATE).asText();
        for (JsonNode existing : api.get("/api/templates")) {
            if (existing.path(TEMPLATE).asText().equals(name)
                    && devices(existing).equals(devices(template))) {
                return;
            }
        }
        api.send("POST", "/api/templates", template);
    }

    private static MissionDevices devices(JsonNode template) {
        try {
            return MissionTemplate.read(NgsiJson.write(template)).devices();
        } catch (RejectedException e) {
            throw new ControlPlaneException(
                    "template %s cannot be read: %s".formatted(template.path(TEMPLATE), e.getMessage()), e);
        }
    }

    private void mission(JsonNode mission) {
        for (JsonNode existing : api.get("/api/missions")) {
            if (existing.path(MISSION).equals(mission.path(MISSION))
                    && ACTIVE.contains(existing.at("/status/state").asText())) {
                return;
            }
        }
        ObjectNode body = mission.deepCopy();
        body.remove(MISSION);
        api.send("POST", "/api/missions" + ControlApi.part(mission.path(MISSION).asText()) + "/start", body);
    }

    private boolean has(String path, String member, JsonNode desired) {
        for (JsonNode existing : api.get(path)) {
            if (existing.path(member).equals(desired.path(member))) {
                return true;
            }
        }
        return false;
    }
}
