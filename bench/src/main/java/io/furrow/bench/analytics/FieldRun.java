package io.furrow.bench.analytics;

import java.io.IOException;
import java.lang.management.ManagementFactory;
import java.util.Locale;
import java.util.Map;

import com.sun.management.OperatingSystemMXBean;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.connector.datagen.source.GeneratorFunction;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;

import io.furrow.analytics.field.KnownFields;
import io.furrow.analytics.temperature.AssignFields;
import io.furrow.analytics.temperature.Reading;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.FiwareScope;

/** Points per second and core through the operator that joins readings with fields, beside the bare loop over the index. */
public final class FieldRun {
    /** @param perCore points per second of processor time, the making of the readings included */
    public record Result(String what, long points, double perSecond, double perCore) {
        @Override
        public String toString() {
            return String.format(
                    Locale.ROOT, "%-28s %,9d points  %,11.0f/s  %,11.0f/s and core", what, points, perSecond, perCore);
        }
    }

    private interface Work {
        void run() throws Exception;
    }

    private static final int VALUE_BYTES = 400;

    private FieldRun() {}

    public static void main(String... args) throws Exception {
        MadeUpFields fields = new MadeUpFields(Integer.parseInt(args[0]), Integer.parseInt(args[1]));
        long points = Long.parseLong(args[2]);
        for (int round = 0; round < 3; round++) {
            System.out.println(loop(fields, points));
            System.out.println(join(fields, points, 1));
            System.out.println(join(fields, points, 2));
        }
    }

    /** The bare loop. */
    public static Result loop(MadeUpFields fields, long points) throws Exception {
        KnownFields known = KnownFields.read(fields);
        long[] found = new long[1];
        Result result = measure("bare loop", points, () -> {
            for (long n = 0; n < points; n++) {
                found[0] += known.covering(fields.position(n), 1).size();
            }
        });
        if (found[0] == 0) {
            throw new IOException("no point is in any field: there was nothing to measure");
        }
        return result;
    }

    /** Readings from memory through the operator. */
    public static Result join(MadeUpFields fields, long points, int parallelism) throws Exception {
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.createLocalEnvironment(parallelism, settings);
        GeneratorFunction<Long, Reading> nth = n ->
                new Reading("urn:ngsi-ld:Thermometer:1", FiwareScope.DEFAULT, fields.position(n), 18, "id", record(n));
        DataStream<Reading> readings = env.fromSource(
                new DataGeneratorSource<>(nth, points, TypeInformation.of(Reading.class)),
                WatermarkStrategy.noWatermarks(),
                "Readings");
        DataStream<TopicRecord> changes = env.fromData(fields.read(), TypeInformation.of(TopicRecord.class));
        readings.connect(changes.broadcast(KnownFields.BROADCAST))
                .process(new AssignFields(fields))
                .sinkTo(new DiscardingSink<>());
        return measure("join, " + parallelism + " subtasks", points, env::execute);
    }

    private static TopicRecord record(long n) {
        return TopicRecord.of("data.raw", n, "urn:ngsi-ld:Thermometer:1", new byte[VALUE_BYTES], Map.of());
    }

    private static Result measure(String what, long points, Work work) throws Exception {
        OperatingSystemMXBean process = (OperatingSystemMXBean) ManagementFactory.getOperatingSystemMXBean();
        long cpu = process.getProcessCpuTime();
        long begin = System.nanoTime();
        work.run();
        double seconds = (System.nanoTime() - begin) / 1e9;
        double cores = (process.getProcessCpuTime() - cpu) / 1e9;
        return new Result(what, points, points / seconds, points / cores);
    }
}
