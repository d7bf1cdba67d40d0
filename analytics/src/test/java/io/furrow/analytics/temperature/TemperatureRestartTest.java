package io.furrow.analytics.temperature;

import java.util.List;
import java.util.Random;
import java.util.Set;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.junit.jupiter.api.Tag;

import io.furrow.analytics.field.FieldInput;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.restart.JobCase;
import io.furrow.flink.restart.RestartContract;
import io.furrow.flink.restart.Restarts;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

@Tag("full")
class TemperatureRestartTest extends RestartContract {
    TemperatureRestartTest() {
        super("temperature", Case::new);
    }

    /** One device is defective, one falls silent; some readings are late, some come twice, and some are corrections. */
    private static final class Case extends JobCase {
        private static final long START = 1_700_000_000_000L;
        private static final int STEP = 250;

        private final boolean corrects;

        Case(long seed) {
            Random random = Restarts.random(seed);
            corrects = random.nextBoolean();
            for (int i = 0; i < 480; i++) {
                int device = i % 6;
                long now = START + (long) i * STEP;
                double value = device == 3 ? 60 : 18 + random.nextInt(10) / 10.0;
                if (device == 5 && i > 160) {
                    continue;
                }
                TopicRecord reading = Farm.north("t" + device, value, now - random.nextInt(2_000));
                arrivals.add(new Arrival(reading, false));
                if (random.nextInt(20) == 0) {
                    arrivals.add(new Arrival(reading, false));
                }
                if (i > 240 && random.nextInt(5) == 0) {
                    long late = now - 45_000 - random.nextInt(20_000);
                    arrivals.add(new Arrival(Farm.north("t" + device, 30, late), true));
                }
                if (corrects && random.nextInt(12) == 0) {
                    long belated = now - bound() - 1_500 - random.nextInt(3_000);
                    arrivals.add(new Arrival(Farm.north("t" + random.nextInt(3), 18.5, belated), true));
                }
            }
        }

        @Override
        public long bound() {
            return 3_000;
        }

        @Override
        public JobOptions options(int parallelism) {
            return Farm.options(
                    Farm.FIELDS,
                    "--parallelism=" + parallelism,
                    "--window=20s",
                    "--slide=10s",
                    "--allowed-lateness=" + (corrects ? "15s" : "0s"));
        }

        @Override
        public DataStream<TopicRecord> define(
                StreamExecutionEnvironment env, DataStream<TopicRecord> records, JobOptions options) {
            TemperatureOptions job = (TemperatureOptions) options;
            return TemperatureJob.define(
                    new TemperatureJob.Inputs(records, FieldInput.of(env, job, job.fields())), job);
        }

        @Override
        public Set<String> topics() {
            return Set.of(Topics.TEMPERATURE, Topics.TEMPERATURE_LATE);
        }

        @Override
        public List<String> judges() {
            return List.of("Deduplicate events by id", "Cast one vote per device");
        }

        /** A corrected result replaces the one before. */
        @Override
        public String identity(TopicRecord record) {
            Entity entity = JobRun.entity(record);
            return entity.number("windowStart")
                    .filter(start -> record.topic().equals(Topics.TEMPERATURE))
                    .map(start -> entity.id() + "@" + start)
                    .orElse(Restarts.text(record));
        }
    }
}
