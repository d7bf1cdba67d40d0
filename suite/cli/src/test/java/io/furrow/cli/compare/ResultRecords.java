package io.furrow.cli.compare;

import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

/** Entities as the analytics jobs write them, and what a collector makes of them. */
final class ResultRecords {
    static final long T0 = 1_777_600_000_000L;

    private ResultRecords() {}

    /** @param times start and newest time, seconds after {@link #T0} */
    static Entity encounter(String pair, String phase, double minDistance, int... times) {
        long start = T0 + times[0] * 1000L;
        return Entity.builder("Analytics:Collision:" + pair, "Analytics:Collision")
                .number("distance", minDistance + 1)
                .integer("time", T0 + times[1] * 1000L)
                .text("Device1_ID", pair.substring(0, 1))
                .text("Device1_Mission", "weeding")
                .text("Device2_ID", pair.substring(1))
                .text("Device2_Mission", "weeding")
                .text("encounter", pair + "@" + start)
                .text("phase", phase)
                .number("minDistance", minDistance)
                .integer("startTime", start)
                .build();
    }

    static Entity entered(String device, String field, int start) {
        return presence(device, field, "entered", start, start).build();
    }

    static Entity left(String device, String field, int start, int end) {
        return presence(device, field, "left", start, end)
                .integer("dwell", (end - start) * 1000L)
                .build();
    }

    static Entity left(String device, String type, String field, int start, int end) {
        return presence(device, field, "left", start, end)
                .text("deviceType", type)
                .text("stay", type + device + field + "-" + (T0 + start * 1000L))
                .build();
    }

    private static EntityBuilder presence(String device, String field, String phase, int start, int time) {
        return Entity.builder("Analytics:Presence:" + device + field, "Analytics:Presence")
                .text("device", device)
                .text("field", field)
                .text("phase", phase)
                .text("cause", "moved")
                .integer("time", T0 + time * 1000L)
                .text("stay", device + field + "-" + (T0 + start * 1000L))
                .integer("startTime", T0 + start * 1000L)
                .text("Mission", "weeding");
    }

    /** @param mean NaN for none; a window of ten seconds */
    static Entity average(String field, int start, double mean, String quality, String... suspects) {
        EntityBuilder entity = Entity.builder("Analytics:FieldTemperature:" + field, "Analytics:FieldTemperature")
                .text("field", field);
        if (Double.isNaN(mean)) {
            entity.attribute("averageTemperature", "Float", JsonNodeFactory.instance.nullNode());
        } else {
            entity.number("averageTemperature", mean);
        }
        return entity.integer("devices", 4)
                .texts("suspects", List.of(suspects))
                .integer("windowStart", T0 + start * 1000L)
                .integer("windowEnd", T0 + (start + 10) * 1000L)
                .text("quality", quality)
                .build();
    }

    /** What a replay found. */
    static SideResults side(String name, Entity... entities) {
        ResultCollector collector = new ResultCollector(null);
        for (Entity entity : entities) {
            collector.add(kind(entity), 0, "farm|/", entity);
        }
        return side(name, collector);
    }

    static SideResults side(String name, ResultCollector collector) {
        Map<ResultKind, List<AnalyticsResult>> spans = new EnumMap<>(ResultKind.class);
        for (ResultKind kind : ResultKind.values()) {
            spans.put(kind, collector.spans(kind));
        }
        return new SideResults(name, collector.epoch(), spans, Set.of());
    }

    static ResultKind kind(Entity entity) {
        return switch (entity.type()) {
            case "Analytics:Collision" -> ResultKind.ENCOUNTERS;
            case "Analytics:Presence" -> ResultKind.STAYS;
            default -> ResultKind.AVERAGES;
        };
    }
}
