package io.furrow.ingest.normalize;

import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.restart.JobCase;
import io.furrow.flink.restart.RestartContract;
import io.furrow.flink.restart.Restarts;
import io.furrow.ingest.CollectedOutput;
import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;

class NormalizeRestartTest extends RestartContract {
    NormalizeRestartTest() {
        super("normalize", Case::new);
    }

    /** Notifications of one to three entities, some of which cannot be read. */
    private static final class Case extends JobCase {
        Case(long seed) {
            Random random = Restarts.random(seed);
            for (int i = 0; i < 300; i++) {
                long received = 1_700_000_000_000L + i * 100L;
                StringBuilder entities = new StringBuilder();
                for (int n = random.nextInt(3); n >= 0; n--) {
                    entities.append(entities.length() == 0 ? "" : ",")
                            .append("{'id':'t%d','type':'T','v':{'type':'Number','value':%d,'metadata':{}}}"
                                    .formatted(n, random.nextInt(1_000_000)));
                }
                String body = "{'subscriptionId':'s','data':[" + entities + (random.nextInt(10) == 0 ? "" : "]}");
                arrivals.add(new Arrival(notification(body, received), false));
            }
        }

        private static TopicRecord notification(String body, long received) {
            return TopicRecord.of(
                    "ngsi.notifications",
                    received,
                    "s",
                    body.replace('\'', '"').getBytes(UTF_8),
                    Map.of("Fiware-Service", "farm", "Fiware-Servicepath", "/north"));
        }

        @Override
        public long bound() {
            return 0;
        }

        @Override
        public JobOptions options(int parallelism) {
            NormalizeOptions options = new NormalizeOptions();
            JobCommandLine.of(options).parseArgs("--parallelism=" + parallelism);
            return options;
        }

        @Override
        public DataStream<TopicRecord> define(
                StreamExecutionEnvironment env, DataStream<TopicRecord> records, JobOptions options) {
            CollectedOutput out = new CollectedOutput();
            NormalizeJob.define(records, out, (NormalizeOptions) options);
            return out.all();
        }

        @Override
        public Set<String> topics() {
            return Set.of("data.raw", "ngsi.notifications.dead");
        }

        @Override
        public List<String> judges() {
            return List.of();
        }

        /** With the event's id, by which a repetition is known. */
        @Override
        public String content(TopicRecord record) {
            return Restarts.text(record) + " " + record.headers().get(HeaderNames.CE_ID);
        }
    }
}
