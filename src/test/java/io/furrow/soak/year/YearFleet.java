package io.furrow.soak.year;

import java.net.URI;
import java.time.Duration;
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
import io.furrow.soak.control.Until;
import io.furrow.soak.devices.ProgramEvent;
import io.furrow.soak.year.Tap.Report;

/**
 * The farm's devices: those of running missions report once a second. At all times one device has a clock two hours
 * slow, and another names a new mission in each report. The first two tractors are close to each other for one of five
 * seconds.
 */
final class YearFleet implements AutoCloseable {
    static final int MISSIONS = 3;
    static final String SLOW = "urn:ngsi-ld:Robot:slow";
    static final String INVENTS = "urn:ngsi-ld:Robot:invents-missions";
    static final double LONGITUDE = -3.47;

    private static final int DEVICES_OF_A_MISSION = 10;
    private static final long SLOW_MILLIS = TimeUnit.HOURS.toMillis(2);
    private static final int TRACTORS = 0;
    private static final int SECONDS_OF_A_ROUND = 5;
    private static final double METER = 1 / 111_195.0;
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final URI contextBroker;
    private final Set<String> reporting = ConcurrentHashMap.newKeySet();
    private final Set<String> reportOnce = ConcurrentHashMap.newKeySet();
    private final Map<Report, ProgramEvent> tractors = new ConcurrentHashMap<>();
    private final Map<Report, ProgramEvent> thermometers = new ConcurrentHashMap<>();
    private volatile int second;
    private volatile boolean near;
    private final ScheduledExecutorService clock = Executors.newSingleThreadScheduledExecutor();

    YearFleet(URI contextBroker) {
        this.contextBroker = contextBroker;
    }

    /** Ids of the devices of a day's mission. */
    static List<String> devices(int mission) {
        String type = mission == TRACTORS ? "Tractor" : "Thermometer";
        return IntStream.range(0, DEVICES_OF_A_MISSION)
                .mapToObj(number -> "urn:ngsi-ld:%s:%d".formatted(type, mission * DEVICES_OF_A_MISSION + number))
                .toList();
    }

    /** Ids of the devices of all missions of a day. */
    static List<String> devices() {
        return IntStream.range(0, MISSIONS)
                .mapToObj(YearFleet::devices)
                .flatMap(List::stream)
                .toList();
    }

    void start() {
        clock.scheduleAtFixedRate(this::report, 0, 1, TimeUnit.SECONDS);
    }

    /** Latitude of the thermometers of a mission. */
    static double latitude(int mission) {
        return 40.3 + mission * 0.01;
    }

    static int missionOf(String device) {
        return number(device) / DEVICES_OF_A_MISSION;
    }

    private static int number(String device) {
        return Integer.parseInt(device.substring(device.lastIndexOf(':') + 1));
    }

    void begin(int mission) {
        if (mission == TRACTORS) {
            second = 0;
        }
        reporting.addAll(devices(mission));
    }

    void end(int mission) {
        if (mission == TRACTORS) {
            awaitParted();
        }
        devices(mission).forEach(reporting::remove);
    }

    /** Waits until no encounter is ongoing; the next one begins a second later at the earliest. */
    void awaitParted() {
        Until.isTrue("the tractors have parted", TIMEOUT, () -> !near);
    }

    /** Makes a device far from all fields report once. */
    void reportOnce(String device) {
        reportOnce.add(device);
    }

    /** Reported positions of tractors, by report. */
    Map<Report, ProgramEvent> tractors() {
        return tractors;
    }

    /** Reported values of thermometers, by report. */
    Map<Report, ProgramEvent> thermometers() {
        return thermometers;
    }

    private void report() {
        long now = System.currentTimeMillis();
        near = second++ % SECONDS_OF_A_ROUND == 1 && !reporting.isEmpty();
        ArrayNode entities = NODES.arrayNode();
        for (String id : new ArrayList<>(reporting)) {
            entities.add(id.contains("Tractor") ? tractor(id, now) : thermometer(id, now));
        }
        for (String id : new ArrayList<>(reportOnce)) {
            entities.add(attribute(entity(id, now), "Latitude", latitude(-1)));
            reportOnce.remove(id);
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
        int number = number(id);
        double meters = number == 1 ? near ? 2 : 20 : number * 100.0;
        double latitude = latitude(TRACTORS) + meters * METER;
        ObjectNode reported = NODES.objectNode().put("time", now);
        reported.putArray("position").add(latitude).add(LONGITUDE);
        tractors.put(new Report(id, now), new ProgramEvent(now, id, "sent", reported));
        ObjectNode entity = entity(id, now);
        attribute(entity, "Latitude", latitude);
        return attribute(entity, "Longitude", LONGITUDE);
    }

    private ObjectNode thermometer(String id, long now) {
        int number = number(id);
        double value = 15 + now / 1000 % 100 / 10.0 + number % DEVICES_OF_A_MISSION * 0.02;
        thermometers.put(
                new Report(id, now),
                new ProgramEvent(
                        now, id, "sent", NODES.objectNode().put("time", now).put("value", value)));
        ObjectNode entity = entity(id, now);
        attribute(entity, "Temperature", value);
        attribute(entity, "Latitude", latitude(missionOf(id)));
        return attribute(entity, "Longitude", LONGITUDE + number % DEVICES_OF_A_MISSION * 20 * METER);
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
