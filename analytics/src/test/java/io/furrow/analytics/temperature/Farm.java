package io.furrow.analytics.temperature;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import picocli.CommandLine;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

/** Records as a source writes them, from devices on the fields of {@code fields.geojson}. */
public final class Farm {
    public static final Path FIELDS = Path.of("src/test/resources/field/fields.geojson");
    public static final FiwareScope SCOPE = new FiwareScope("farm", "/");
    public static final InputScope INPUT = new InputScope(Topics.RAW, SCOPE);

    static final List<TopicRecord> FOUR_DEVICES_ONE_DEFECTIVE =
            List.of(north("t1", 18, 1_000), north("t2", 19, 2_000), north("t4", 60, 3_000), north("t3", 20, 4_000));

    private Farm() {}

    /** A thermometer inside the field {@code north} alone. */
    public static TopicRecord north(String device, double temperature, long time) {
        return reading(device, temperature, 52, 12, time);
    }

    static TopicRecord north(String type, String device, double temperature, long time) {
        return reading(type, device, temperature, 52, 12, time);
    }

    static TopicRecord reading(String device, double temperature, double latitude, double longitude, long time) {
        return reading("Thermometer", device, temperature, latitude, longitude, time);
    }

    private static TopicRecord reading(
            String type, String device, double temperature, double latitude, double longitude, long time) {
        return changed(
                SCOPE,
                time,
                Entity.builder(device, type)
                        .number("Latitude", latitude)
                        .number("Longitude", longitude)
                        .number("Temperature", temperature)
                        .integer("Time", time)
                        .build());
    }

    static TopicRecord changed(FiwareScope scope, long time, Entity entity) {
        java.time.Instant received = java.time.Instant.ofEpochMilli(time);
        Map<String, String> headers = EntityEvent.of(
                        entity, scope, received, EventTimeRule.within(Duration.ZERO), Origin.NOTIFICATION)
                .headers("/ngsi/test");
        return TopicRecord.of(Topics.RAW, time, entity.id(), entity.toBytes(), headers);
    }

    static TopicRecord garbage(byte[] value, long time) {
        return TopicRecord.of(Topics.RAW, time, "garbage", value, Map.of());
    }

    /** Options as the command line gives them. */
    public static TemperatureOptions options(Path fields, String... more) {
        TemperatureOptions options = new TemperatureOptions();
        CommandLine line = JobCommandLine.of(options).setOverwrittenOptionsAllowed(true);
        List<String> args = new ArrayList<>(List.of("--fields", fields.toString()));
        Stream.of(more).forEach(args::add);
        line.parseArgs(args.toArray(String[]::new));
        return options;
    }
}
