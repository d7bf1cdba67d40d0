package io.furrow.ingest;

import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.junit.jupiter.api.Tag;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.TopicNames;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.restart.JobCase;
import io.furrow.flink.restart.RestartContract;
import io.furrow.flink.restart.Restarts;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

@Tag("full")
class IngestRestartTest extends RestartContract {
    IngestRestartTest() {
        super("ingest", Case::new);
    }

    /**
     * Events of a few entities with deletions, garbage and late events. What comes again under the id of an event says something
     * else, so that it would show if it passed.
     */
    private static final class Case extends JobCase {
        private static final int STEP = 100;
        private static final long START = 1_700_000_000_000L;

        private final Random random;

        Case(long seed) {
            random = Restarts.random(seed);
            for (int i = 0; i < 450; i++) {
                long now = START + (long) i * STEP - random.nextInt(1_000);
                String key = "t" + random.nextInt(6);
                arrivals.add(new Arrival(event("e" + i, key, now), false));
                if (i > 0 && random.nextInt(10) == 0) {
                    again(arrivals.get(arrivals.size() - 1 - random.nextInt(Math.min(20, arrivals.size()))));
                }
                if (i > 220 && random.nextInt(4) == 0) {
                    TopicRecord late = event("late" + i, key, now - 22_000 - random.nextInt(1_000));
                    arrivals.add(new Arrival(late, true));
                }
            }
        }

        private void again(Arrival arrival) {
            TopicRecord first = arrival.record();
            String key = new String(first.key(), UTF_8);
            String id = first.headers().get(HeaderNames.CE_ID);
            arrivals.add(new Arrival(entity(id, key, first.timestamp()), true));
        }

        private TopicRecord event(String id, String key, long time) {
            return switch (random.nextInt(20)) {
                case 0 ->
                    record(
                            Map.of(HeaderNames.CE_ID, id, HeaderNames.CE_TYPE, HeaderNames.TYPE_DELETED),
                            key,
                            time,
                            null);
                case 1 -> record(Map.of(HeaderNames.CE_ID, id), key, time, "{no json".getBytes(UTF_8));
                default -> entity(id, key, time);
            };
        }

        private TopicRecord entity(String id, String key, long time) {
            Entity entity = Entity.builder(key, "Thermometer")
                    .text("Domain", "farm")
                    .text("Mission", random.nextBoolean() ? "weeding" : "")
                    .integer("a" + random.nextInt(3), random.nextInt(1_000_000))
                    .build();
            return record(Map.of(HeaderNames.CE_ID, id), key, time, entity.toBytes());
        }

        private static TopicRecord record(Map<String, String> headers, String key, long time, byte[] value) {
            return new TopicRecord(Topics.RAW, 0, 7, time, key.getBytes(UTF_8), value, headers);
        }

        @Override
        public long bound() {
            return 2_000;
        }

        @Override
        public JobOptions options(int parallelism) {
            IngestOptions options = new IngestOptions();
            JobCommandLine.of(options).parseArgs("--parallelism=" + parallelism, "--repeat-window=10s");
            return options;
        }

        @Override
        public DataStream<TopicRecord> define(
                StreamExecutionEnvironment env, DataStream<TopicRecord> records, JobOptions options) {
            TopicRecord nobody = record(Map.of(), "|/|of-nobody", 0, null).to(Topics.DEVICES);
            DataStream<TopicRecord> devices = env.fromData(List.of(nobody), TypeInformation.of(TopicRecord.class))
                    .setParallelism(1)
                    .uid("devices")
                    .assignTimestampsAndWatermarks(KafkaConnectors.alwaysIdle())
                    .uid("no-hindrance")
                    .setParallelism(1);
            DataStream<TopicRecord> asInPartitions = records.keyBy(record -> new String(record.key(), UTF_8));
            CollectedOutput out = new CollectedOutput();
            IngestJob.define(
                    new IngestInputs(
                            asInPartitions,
                            devices,
                            FixedDevices.of(),
                            TopicSnapshot.NONE,
                            TopicSnapshot.NONE,
                            TopicSnapshot.NONE,
                            TopicNames.NONE),
                    out,
                    (IngestOptions) options);
            return out.all();
        }

        @Override
        public Set<String> topics() {
            return Set.of("data.farm.realtime", "data.raw.dead", Topics.LATEST, Topics.CATALOG);
        }

        @Override
        public List<String> judges() {
            return List.of("Deduplicate events by id");
        }

        /** The last of a key of compacted topics. */
        @Override
        public String identity(TopicRecord record) {
            return Set.of(Topics.LATEST, Topics.CATALOG).contains(record.topic())
                    ? record.topic() + " " + new String(record.key(), UTF_8)
                    : Restarts.text(record);
        }
    }
}
