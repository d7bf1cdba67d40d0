package io.furrow.bench.analytics;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.connector.datagen.source.GeneratorFunction;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;

import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.presence.PresenceRules;
import io.furrow.analytics.presence.PresenceTransition;
import io.furrow.analytics.presence.TrackPresence;
import io.furrow.analytics.temperature.AssignFields;
import io.furrow.analytics.temperature.Reading;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.analytics.load.SyntheticFields;
import io.furrow.bench.frame.CpuReading;
import io.furrow.bench.frame.Figures;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.BroadcastLatenessOperator;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.position.Position;

/** Measures points per second and core through the operators that join readings and devices with fields, beside a bare loop. */
final class FieldMeasurement {
    private static final int VALUE_BYTES = 400;
    private static final int ROUNDS = 3;
    private static final int DEVICES = 10_000;
    private static final String TOPIC = "data.raw";
    private static final PresenceRules PRESENCE = new PresenceRules(Duration.ofMinutes(5), Duration.ZERO);

    private final SyntheticFields fields;
    private final long points;
    private final Consumer<String> progress;

    private interface Work {
        void run() throws Exception;
    }

    /** The cost of a join. */
    private record Taken(double seconds, double cpuSeconds) {}

    /**
     * @param fields number of fields
     * @param corners of each
     * @param points of each round
     */
    FieldMeasurement(int fields, int corners, long points, Consumer<String> progress) {
        this.fields = new SyntheticFields(fields, corners);
        this.points = points;
        this.progress = progress;
    }

    /** Runs alternating rounds, of which only the last counts; earlier ones warm up the JVM. */
    void run(Iterable<Integer> parallelisms, Figures figures) throws Exception {
        for (int parallelism : parallelisms) {
            Taken bare = null;
            Taken temperature = null;
            Taken presence = null;
            for (int round = 1; round <= ROUNDS; round++) {
                bare = measure(this::loop);
                temperature = measure(() -> temperature(parallelism));
                presence = measure(() -> presence(parallelism));
                progress.accept("fields on %d, round %d of %d".formatted(parallelism, round, ROUNDS));
            }
            add("temperature", parallelism, temperature, bare, figures);
            add("presence", parallelism, presence, bare, figures);
        }
    }

    private void add(String job, int parallelism, Taken taken, Taken bare, Figures figures) {
        figures.add(
                "join of", job,
                "cores", parallelism,
                "points/s", points / taken.seconds,
                "per core", points / taken.cpuSeconds,
                "bare loop", points / bare.seconds);
    }

    private void loop() throws IOException {
        FieldVersions known = FieldVersions.read(fields);
        long found = 0;
        for (long n = 0; n < points; n++) {
            found += known.covering(fields.position(n), 1).size();
        }
        if (found == 0) {
            throw new IOException("no point is in any field: there was nothing to measure");
        }
    }

    private void temperature(int parallelism) throws Exception {
        StreamExecutionEnvironment env = environment(parallelism);
        SyntheticFields where = fields; // this object is not serialized with the job
        GeneratorFunction<Long, Reading> nth = n -> new Reading(
                "urn:ngsi-ld:Thermometer:1",
                "Thermometer",
                FiwareScope.DEFAULT,
                where.position(n),
                18,
                "id",
                record(n));
        stream(env, nth, Reading.class, WatermarkStrategy.noWatermarks())
                .connect(changes(env).broadcast(FieldVersions.BROADCAST))
                .process(new AssignFields(fields))
                .sinkTo(new DiscardingSink<>());
        env.execute();
    }

    private void presence(int parallelism) throws Exception {
        StreamExecutionEnvironment env = environment(parallelism);
        SyntheticFields where = fields;
        GeneratorFunction<Long, PositionFix> nth = n -> {
            Position position = where.position(n);
            String id = "urn:ngsi-ld:Robot:" + n % DEVICES;
            long time = Fleet.START + n * 1000 / DEVICES;
            double latitude = position.latitude();
            double longitude = position.longitude();
            return new PositionFix(
                    TOPIC, "farm|/|" + id, id, "", "", "", latitude, longitude, Double.NaN, Double.NaN, time);
        };
        stream(
                        env,
                        nth,
                        PositionFix.class,
                        WatermarkStrategy.<PositionFix>forBoundedOutOfOrderness(Duration.ofSeconds(1))
                                .withTimestampAssigner((fix, previous) -> fix.time()))
                .keyBy(PositionFix::key)
                .connect(changes(env).broadcast())
                .transform(
                        "TrackPresence",
                        TypeInformation.of(PresenceTransition.class),
                        new BroadcastLatenessOperator<>(
                                new TrackPresence(PRESENCE, fields), List.of(FieldVersions.BROADCAST)))
                .sinkTo(new DiscardingSink<>());
        env.execute();
    }

    private static StreamExecutionEnvironment environment(int parallelism) {
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        return StreamExecutionEnvironment.createLocalEnvironment(parallelism, settings);
    }

    private <T> DataStream<T> stream(
            StreamExecutionEnvironment env, GeneratorFunction<Long, T> nth, Class<T> type, WatermarkStrategy<T> marks) {
        return env.fromSource(
                new DataGeneratorSource<>(nth, points, TypeInformation.of(type)), marks, type.getSimpleName());
    }

    private DataStream<TopicRecord> changes(StreamExecutionEnvironment env) {
        return env.fromData(
                fields.read(), TypeInformation.of(TopicRecord.class)); // its end does not hold back event time
    }

    private static TopicRecord record(long n) {
        return TopicRecord.of(TOPIC, n, "urn:ngsi-ld:Thermometer:1", new byte[VALUE_BYTES], Map.of());
    }

    private static Taken measure(Work work) throws Exception {
        CpuReading begin = CpuReading.now();
        work.run();
        CpuReading end = CpuReading.now();
        return new Taken(end.seconds(begin), end.cpuSeconds(begin));
    }
}
