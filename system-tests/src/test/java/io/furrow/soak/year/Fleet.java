package io.furrow.soak.year;

import java.net.URI;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.soak.control.Http;
import io.furrow.soak.devices.ProgramEvent;
import io.furrow.soak.year.Tap.Report;

/**
 * The farm's devices, of which those of running missions report once a second; and at all times one whose clock is two hours
 * slow, and one that names a new mission with each report. The first two tractors meet for three of ten seconds.
 */
final class Fleet implements AutoCloseable {
    static final int MISSIONS = 3;
    static final String SLOW = "urn:ngsi-ld:Robot:slow";
    static final String INVENTS = "urn:ngsi-ld:Robot:invents-missions";

    private static final int DEVICES_OF_A_MISSION = 10;
    private static final long SLOW_MILLIS = TimeUnit.HOURS.toMillis(2);
    private static final int TRACTORS = 0;
    private static final double METER = 1 / 111_195.0;
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final URI contextBroker;
    private final Set<String> reporting = ConcurrentHashMap.newKeySet();
    private final Map<Report, ProgramEvent> tractors = new ConcurrentHashMap<>();
    private final ScheduledExecutorService clock = Executors.newSingleThreadScheduledExecutor();

    Fleet(URI contextBroker) {
        this.contextBroker = contextBroker;
    }

    /** Ids of the devices of a day's mission. */
    static List<String> devices(int mission) {
        String type = mission == TRACTORS ? "Tractor" : "Thermometer";
        return IntStream.range(0, DEVICES_OF_A_MISSION)
                .mapToObj(number -> "urn:ngsi-ld:%s:%d".formatted(type, mission * DEVICES_OF_A_MISSION + number))
                .toList();
    }

    void start() {
        clock.scheduleAtFixedRate(this::report, 0, 1, TimeUnit.SECONDS);
    }

    void begin(int mission) {
        reporting.addAll(devices(mission));
    }

    void end(int mission) {
        devices(mission).forEach(reporting::remove);
    }

    /** What the tractors told of their place, by report. */
    Map<Report, ProgramEvent> tractors() {
        return tractors;
    }

    private void report() {
        long now = System.currentTimeMillis();
        ArrayNode entities = NODES.arrayNode();
        for (String id : new ArrayList<>(reporting)) {
            entities.add(id.contains("Tractor") ? tractor(id, now) : thermometer(id, now));
        }
        entities.add(entity(SLOW, now - SLOW_MILLIS));
        ObjectNode invents = entity(INVENTS, now);
        attribute(invents, "Mission", "invented-" + now / 1000);
        entities.add(attribute(invents, "Domain", FarmYear.DOMAIN));
        ObjectNode update = NODES.objectNode().put("actionType", "append");
        update.set("entities", entities);
        Http.send(
                "POST",
                contextBroker.resolve("/v2/op/update"),
                NgsiJson.write(update),
                "fiware-service",
                "farm",
                "fiware-servicepath",
                "/");
    }

    private ObjectNode tractor(String id, long now) {
        int number = Integer.parseInt(id.substring(id.lastIndexOf(':') + 1));
        long second = now / 1000 % 10;
        boolean near = second >= 3 && second <= 5;
        double meters = number == 1 ? near ? 2 : 20 : number * 100.0;
        double latitude = 40.3 + meters * METER;
        ObjectNode told = NODES.objectNode().put("time", now);
        told.putArray("position").add(latitude).add(-3.48);
        tractors.put(new Report(id, now), new ProgramEvent(now, id, "sent", told));
        ObjectNode entity = entity(id, now);
        attribute(entity, "Latitude", latitude);
        return attribute(entity, "Longitude", -3.48);
    }

    private static ObjectNode thermometer(String id, long now) {
        ObjectNode entity = entity(id, now);
        attribute(entity, "Temperature", 15 + now / 1000 % 100 / 10.0);
        attribute(entity, "Latitude", 40.31);
        return attribute(entity, "Longitude", -3.47);
    }

    private static ObjectNode entity(String id, long time) {
        ObjectNode entity = NODES.objectNode().put("id", id).put("type", id.split(":")[2]);
        entity.putObject("Time").put("type", "Number").put("value", time);
        return entity;
    }

    private static ObjectNode attribute(ObjectNode entity, String name, Object value) {
        entity.putObject(name)
                .put("type", value instanceof Double ? "Number" : "Text")
                .set("value", NgsiJson.mapper().valueToTree(value));
        return entity;
    }

    @Override
    public void close() {
        clock.shutdownNow();
    }
}
