package io.furrow.analytics.presence;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.junit.jupiter.api.Tag;

import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.restart.JobCase;
import io.furrow.flink.restart.RestartContract;
import io.furrow.flink.restart.Restarts;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

@Tag("full")
class PresenceRestartTest extends RestartContract {
    PresenceRestartTest() {
        super("presence", Case::new);
    }

    /** Devices that walk through the fields of a story, with late positions. */
    private static final class Case extends JobCase {
        private static final int STEP = 100;
        private static final long START = 1_700_000_100_000L;

        private final ArrayList<Plot> plots;

        Case(long seed) {
            Random random = Restarts.random(seed);
            plots = new ArrayList<>(lasting(seed));
            for (int i = 0; i < 450; i++) {
                String device = "d" + random.nextInt(5);
                long now = START + (long) i * STEP;
                arrivals.add(new Arrival(report(random, device, now - random.nextInt(1_000)), false));
                if (i > 220 && random.nextInt(4) == 0) {
                    arrivals.add(new Arrival(report(random, device, now - 12_000 - random.nextInt(10_000)), true));
                }
            }
        }

        /** Of a story at whose end there is a field: into none, nobody comes. */
        private static List<Plot> lasting(long seed) {
            List<Plot> plots = new Story(seed).plots;
            Map<String, Plot> last = new HashMap<>();
            plots.forEach(plot -> last.put(plot.id(), plot));
            return last.values().stream().allMatch(plot -> plot.parts().isEmpty()) ? lasting(seed + 1) : plots;
        }

        private static TopicRecord report(Random random, String device, long time) {
            PositionFix fix = Story.fix(device, random.nextInt(12), random.nextInt(12), time);
            Entity entity = Entity.builder(device, "ROBOT")
                    .number("Latitude", fix.latitude())
                    .number("Longitude", fix.longitude())
                    .build();
            Map<String, String> headers = Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/");
            byte[] key = device.getBytes(UTF_8);
            return new TopicRecord(Topics.RAW, 0, 7, time, key, entity.toBytes(), headers);
        }

        @Override
        public long bound() {
            return 2_000;
        }

        @Override
        public JobOptions options(int parallelism) {
            PresenceOptions options = new PresenceOptions();
            JobCommandLine.of(options).parseArgs("--parallelism=" + parallelism, "--time-to-live=3s", "--dwell=300ms");
            return options;
        }

        @Override
        public DataStream<TopicRecord> define(
                StreamExecutionEnvironment env, DataStream<TopicRecord> records, JobOptions options) {
            ArrayList<Plot> known = plots;
            DataStream<TopicRecord> versions = env.fromData(records(known), TypeInformation.of(TopicRecord.class))
                    .uid("fields")
                    .setParallelism(1)
                    .assignTimestampsAndWatermarks(KafkaConnectors.alwaysIdle())
                    .uid("no-hindrance")
                    .setParallelism(1);
            return PresenceJob.define(
                    new PresenceJob.Inputs(records, new FieldInput(versions, () -> records(known))),
                    (PresenceOptions) options);
        }

        private static List<TopicRecord> records(List<Plot> plots) {
            List<TopicRecord> records = new ArrayList<>();
            plots.forEach(plot -> records.add(plot.record(records.size())));
            return records;
        }

        @Override
        public Set<String> topics() {
            return Set.of("data.presence", "data.presence.late");
        }

        @Override
        public List<String> judges() {
            return List.of("Track presence in fields");
        }
    }
}
