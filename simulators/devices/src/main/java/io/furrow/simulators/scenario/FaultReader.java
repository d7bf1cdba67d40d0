package io.furrow.simulators.scenario;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.simulators.signal.RandomStream;
import io.furrow.simulators.signal.SensorFault;
import io.furrow.simulators.signal.TimeWindow;

/** Reads the faults of a device: {@code "faults": [{"kind": "drift", "perHour": 2, "after": "PT10M"}]}. */
final class FaultReader {
    private static final double MAX = 1e9;

    private final Instant start;

    FaultReader(Instant start) {
        this.start = start;
    }

    /** @param attribute affected attribute; null for all */
    record Wrong(String attribute, SensorFault fault) {}

    /**
     * The faults of one device of a group.
     *
     * @param number of the device in its group, from 1
     * @param attributes names; a fault that names none affects the first
     */
    List<Wrong> faults(ScenarioObjectReader device, long number, long seed, List<String> attributes)
            throws InvalidScenarioException {
        List<Wrong> faults = new ArrayList<>();
        if (!device.has("faults")) {
            return faults;
        }
        for (ScenarioObjectReader each : device.objects("faults")) {
            Wrong wrong = wrong(each, RandomStream.seed(seed, "fault " + faults.size()), attributes);
            boolean mine = isFor(each, number);
            each.end();
            if (mine) {
                faults.add(wrong);
            }
        }
        return faults;
    }

    private Wrong wrong(ScenarioObjectReader json, long seed, List<String> attributes) throws InvalidScenarioException {
        Instant from = start.plus(json.duration("after", Duration.ZERO));
        TimeWindow during = new TimeWindow(from, json.has("for") ? from.plus(json.duration("for")) : null);
        String kind = json.text("kind");
        if (kind.equals("silent")) {
            return new Wrong(null, new SensorFault.Silent(during));
        }
        if (attributes.isEmpty()) {
            throw json.refused("kind", "'%s' is not a fault of this device; it can only be silent".formatted(kind));
        }
        String attribute = json.text("attribute", attributes.get(0));
        if (!attributes.contains(attribute)) {
            throw json.refused(
                    "attribute", "'%s' is not shown; shown are %s".formatted(attribute, String.join(", ", attributes)));
        }
        SensorFault fault = switch (kind) {
            case "stuck" ->
                new SensorFault.Stuck(
                        during, json.has("value") ? Double.valueOf(json.number("value", -MAX, MAX)) : null);
            case "drift" -> new SensorFault.Drift(during, json.number("perHour", -MAX, MAX));
            case "spikes" ->
                new SensorFault.Spikes(during, json.number("share", 0, 1), json.number("height", -MAX, MAX), seed);
            default ->
                throw json.refused(
                        "kind", "'%s' is not a kind of fault; use stuck, drift, spikes or silent".formatted(kind));
        };
        return new Wrong(attribute, fault);
    }

    /** {@code "numbers": [2, 5]} selects devices of the group; all without it. */
    private static boolean isFor(ScenarioObjectReader fault, long number) throws InvalidScenarioException {
        if (!fault.has("numbers")) {
            return true;
        }
        Set<Long> numbers = new HashSet<>();
        for (JsonNode each : fault.node("numbers")) {
            numbers.add(each.asLong(0));
        }
        if (!fault.node("numbers").isArray() || numbers.contains(0L)) {
            throw fault.refused("numbers", "must be a list of the devices' numbers, from 1, as in [1, 3]");
        }
        return numbers.contains(number);
    }
}
