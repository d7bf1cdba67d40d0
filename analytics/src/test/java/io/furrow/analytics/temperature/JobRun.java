package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.BinaryOperator;
import java.util.stream.Collectors;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.Replayed;
import io.furrow.analytics.TestEnvironment;
import io.furrow.analytics.field.FieldInput;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** One run of the job over records in a given order of arrival, with the watermark moving after each of them. */
record JobRun(JobID id, List<TopicRecord> records) {
    /** On the fields of {@link Farm}, with one subtask, so that the order of arrival is the order of the list. */
    static JobRun over(List<TopicRecord> arrivals, String... more) throws Exception {
        List<String> args = new ArrayList<>(List.of("--parallelism", "1", "--out-of-orderness", "1s"));
        args.addAll(List.of(more));
        return over(arrivals, Farm.options(Farm.FIELDS, args.toArray(String[]::new)));
    }

    static JobRun over(List<TopicRecord> arrivals, TemperatureOptions options) throws Exception {
        StreamExecutionEnvironment env = environment(options);
        return over(env, inputs(env, arrivals, options), options);
    }

    /** With fields that change in turn with the arrivals. */
    static JobRun over(RandomCases random) throws Exception {
        TemperatureOptions options = random.options();
        StreamExecutionEnvironment env = environment(options);
        InTurn inTurn = InTurn.readings(random.changesBefore(), env.getParallelism(), JobRun::unknown);
        DataStream<TopicRecord> readings = source(env, random.arrivals(), inTurn, options);
        DataStream<TopicRecord> fields = env.fromData(random.fieldRecords(), TypeInformation.of(TopicRecord.class))
                .setParallelism(1)
                .uid("read-fields")
                .assignTimestampsAndWatermarks(KafkaConnectors.alwaysIdle())
                .setParallelism(1)
                .uid("no-hindrance")
                .filter(InTurn.changes(random.readingsBefore(), env.getParallelism()))
                .setParallelism(1)
                .uid("changes-in-turn");
        return over(env, new TemperatureJob.Inputs(readings, new FieldInput(fields, random.fieldsAtStart())), options);
    }

    private static JobRun over(StreamExecutionEnvironment env, TemperatureJob.Inputs inputs, TemperatureOptions options)
            throws Exception {
        Collected collected = new Collected();
        TemperatureJob.define(inputs, options).sinkTo(collected).uid("collect");
        return new JobRun(env.execute().getJobID(), collected.records());
    }

    static TemperatureJob.Inputs inputs(
            StreamExecutionEnvironment env, List<TopicRecord> arrivals, TemperatureOptions options) {
        return new TemperatureJob.Inputs(source(env, arrivals, options), FieldInput.of(env, options, options.fields()));
    }

    static StreamExecutionEnvironment environment(TemperatureOptions options) {
        StreamExecutionEnvironment env = TestEnvironment.of(options);
        env.setBufferTimeout(0); // each record waits until the job has seen the one before it
        return env;
    }

    static DataStream<TopicRecord> source(
            StreamExecutionEnvironment env, List<TopicRecord> arrivals, TemperatureOptions options) {
        InTurn.Watermarks seen =
                options.inputTopics().replay().isPresent() ? JobRun::unknown : afterEachRecord(options);
        return source(env, arrivals, InTurn.readings(new int[arrivals.size()], env.getParallelism(), seen), options);
    }

    /** As of a replay, or where the job's fields have no event time of their own. */
    private static long unknown(long newest) {
        return InTurn.BEGIN.timestamp();
    }

    private static DataStream<TopicRecord> source(
            StreamExecutionEnvironment env, List<TopicRecord> arrivals, InTurn inTurn, TemperatureOptions options) {
        List<TopicRecord> all = new ArrayList<>(arrivals);
        all.add(0, InTurn.BEGIN);
        return env.fromData(all, TypeInformation.of(TopicRecord.class))
                .setParallelism(1)
                .uid("arrivals")
                .assignTimestampsAndWatermarks(watermarks(options))
                .setParallelism(1)
                .uid("watermarks")
                .filter(inTurn)
                .setParallelism(1)
                .uid("in-turn");
    }

    static WatermarkStrategy<TopicRecord> watermarks(TemperatureOptions options) {
        if (options.inputTopics().replay().isPresent()) {
            return Replayed.watermarks(options);
        }
        InTurn.Watermarks watermarks = afterEachRecord(options);
        return WatermarkStrategy.<TopicRecord>forGenerator(context -> new AfterEachRecord(watermarks))
                .withTimestampAssigner((record, unused) -> record.timestamp());
    }

    private static InTurn.Watermarks afterEachRecord(TemperatureOptions options) {
        long bound = options.outOfOrderness().toMillis();
        return newest -> Math.max(newest, InTurn.BEGIN.timestamp() + bound + 1) - bound - 1;
    }

    List<TopicRecord> to(String topic) {
        return records.stream().filter(record -> record.topic().equals(topic)).toList();
    }

    /** The results, later ones in place of earlier ones for the same field and window, by field and window. */
    List<Entity> results(String topic) {
        BinaryOperator<Entity> later = (first, second) -> second;
        return to(topic).stream()
                .map(JobRun::entity)
                .collect(Collectors.toMap(JobRun::fieldAndWindow, result -> result, later, TreeMap::new))
                .values()
                .stream()
                .sorted(Comparator.comparing(JobRun::fieldAndWindow))
                .toList();
    }

    /** Field → average; of several windows the last. */
    Map<String, Double> averages() {
        Map<String, Double> averages = new TreeMap<>();
        for (Entity result : results(Topics.TEMPERATURE)) {
            averages.put(
                    result.text("field").orElseThrow(),
                    result.number("averageTemperature").orElseThrow());
        }
        return averages;
    }

    private static String fieldAndWindow(Entity result) {
        return result.id() + "@" + result.number("windowStart").orElseThrow();
    }

    static Entity entity(TopicRecord record) {
        try {
            return Entity.parse(record.value());
        } catch (UnreadableException e) {
            throw new AssertionError("the job wrote what nobody can read", e);
        }
    }

    /** Unlike the periodic one it makes lateness a matter of the records alone. */
    private static final class AfterEachRecord implements WatermarkGenerator<TopicRecord> {
        private final InTurn.Watermarks watermarks;
        private long newest = Long.MIN_VALUE;

        AfterEachRecord(InTurn.Watermarks watermarks) {
            this.watermarks = watermarks;
        }

        @Override
        public void onEvent(TopicRecord record, long timestamp, WatermarkOutput output) {
            newest = Math.max(newest, timestamp);
            output.emitWatermark(new Watermark(watermarks.applyAsLong(newest)));
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {}
    }
}
