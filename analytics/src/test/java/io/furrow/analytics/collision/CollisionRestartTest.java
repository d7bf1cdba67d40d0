package io.furrow.analytics.collision;

import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.junit.jupiter.api.Tag;

import io.furrow.flink.device.DeviceInput;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.restart.JobCase;
import io.furrow.flink.restart.RestartContract;
import io.furrow.flink.restart.Restarts;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

@Tag("full")
class CollisionRestartTest extends RestartContract {
    CollisionRestartTest() {
        super("collision", Case::new);
    }

    /** Robots that wander along 30 m, with late positions. */
    private static final class Case extends JobCase {
        private static final int STEP = 100;

        Case(long seed) {
            Random random = Restarts.random(seed);
            double[] east = new double[6];
            for (int i = 0; i < 450; i++) {
                int robot = random.nextInt(east.length);
                east[robot] = Math.floorMod(Math.round(10 * east[robot]) + random.nextInt(51) - 25, 300) / 10.0;
                long now = 1_000_000 + (long) i * STEP;
                arrivals.add(
                        new Arrival(ReportedRun.robot("r" + robot, east[robot], now - random.nextInt(1_000)), false));
                if (i > 220 && random.nextInt(4) == 0) {
                    long late = now - 12_000 - random.nextInt(10_000);
                    arrivals.add(new Arrival(ReportedRun.robot("r" + robot, random.nextInt(30), late), true));
                }
            }
        }

        @Override
        public long bound() {
            return 2_000;
        }

        @Override
        public JobOptions options(int parallelism) {
            return ReportedRun.options(
                    "--parallelism=" + parallelism,
                    "--threshold=5",
                    "--time-to-live=4s",
                    "--dwell=200ms",
                    "--ongoing-every=1s",
                    "--horizon=2s",
                    "--crossed");
        }

        @Override
        public DataStream<TopicRecord> define(
                StreamExecutionEnvironment env, DataStream<TopicRecord> records, JobOptions options) {
            var nobody = new TopicRecord(Topics.DEVICES, 0, 0, 0, "|/|of-nobody".getBytes(UTF_8), null, Map.of());
            DataStream<TopicRecord> devices = env.fromData(List.of(nobody), TypeInformation.of(TopicRecord.class))
                    .uid("read-devices")
                    .setParallelism(1);
            return CollisionJob.define(
                    new CollisionJob.Inputs(records, new DeviceInput(devices, TopicSnapshot.NONE)),
                    (CollisionOptions) options);
        }

        @Override
        public Set<String> topics() {
            return Set.of("data.collision", "data.collision.late");
        }

        @Override
        public List<String> judges() {
            return List.of("Track devices through the grid", "Track the motion of devices");
        }
    }
}
