package io.furrow.ingest.mission;

import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;
import java.util.TreeSet;

import com.mongodb.MongoException;
import com.mongodb.client.MongoClient;
import org.apache.flink.api.common.JobStatus;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.api.connector.source.util.ratelimit.RateLimiterStrategy;
import org.apache.flink.configuration.CheckpointingOptions;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.configuration.RestartStrategyOptions;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.core.execution.JobClient;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.awaitility.Awaitility;
import org.bson.RawBsonDocument;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.flink.TestClusters;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class MongoDiesIT {
    private static final int EVENTS = 20_000;
    private static final List<String> MISSIONS = List.of("weeding", "spraying", "field.7");

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    @Test
    void leavesTheDocumentsOfARunWithoutTheFault(@TempDir Path directory) throws Exception {
        Map<String, TreeSet<String>> undisturbed;
        try (MongoProcess mongo = new MongoProcess(directory.resolve("a"))) {
            job(mongo, Duration.ofMinutes(1), 10 * EVENTS)
                    .getJobExecutionResult()
                    .get();
            undisturbed = documents(mongo);
        }
        assertThat(undisturbed.values().stream().mapToInt(TreeSet::size).sum()).isEqualTo(EVENTS);

        try (MongoProcess mongo = new MongoProcess(directory.resolve("b"))) {
            // With little timeout the job fails now and then and continues from a checkpoint, too.
            // Its events come in slowly enough for three kills, however slow the machine is.
            JobClient job = job(mongo, Duration.ofSeconds(1), EVENTS / 10);
            int kills = killUnderLoad(mongo, job);
            job.getJobExecutionResult().get();

            assertThat(kills).isGreaterThanOrEqualTo(3);
            assertThat(documents(mongo)).isEqualTo(undisturbed);
        }
    }

    /** At three moments while documents come in. */
    private static int killUnderLoad(MongoProcess mongo, JobClient job) throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        int kills = 0;
        long before = 0;
        while (kills < 3) {
            long desired = before + 1 + random.nextInt((int) (EVENTS - before) / 4);
            Awaitility.await("seed " + seed).until(() -> count(mongo) >= desired);
            assertThat(job.getJobStatus().get()).isNotEqualTo(JobStatus.FINISHED);
            before = count(mongo);
            mongo.kill();
            kills++;
            mongo.start();
        }
        return kills;
    }

    @SuppressWarnings("unchecked") // Flink's factory of rate limiters returns a raw type
    private static JobClient job(MongoProcess mongo, Duration timeout, int eventsPerSecond) throws Exception {
        Configuration settings = new Configuration();
        settings.set(CheckpointingOptions.CHECKPOINTING_INTERVAL, Duration.ofMillis(200));
        settings.set(RestartStrategyOptions.RESTART_STRATEGY, "fixed-delay");
        settings.set(RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_ATTEMPTS, 10_000);
        settings.set(RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_DELAY, Duration.ofMillis(100));
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment(settings);
        env.setParallelism(2);
        var access = new MongoAccess(mongo.uri() + "/?serverSelectionTimeoutMS=200", MongoAccess.Waits.of(timeout));
        env.fromSource(
                        new DataGeneratorSource<>(
                                n -> n, EVENTS, RateLimiterStrategy.perSecond(eventsPerSecond), Types.LONG),
                        WatermarkStrategy.noWatermarks(),
                        "numbers")
                .map(n -> Events.reading(MISSIONS.get((int) (n % MISSIONS.size())), n.intValue()))
                .returns(MissionEvent.class)
                .process(new ComposeDocuments())
                .sinkTo(new MissionSink(access, Retention.FOR_EVER, new DiscardingSink<>()));
        return env.executeAsync();
    }

    private static long count(MongoProcess mongo) {
        long count = 0;
        try (MongoClient client = reader(mongo).open()) {
            MissionCollections collections = collections(client);
            for (String name : collections.names()) {
                count += collections.get(name).countDocuments();
            }
        } catch (MongoException e) {
            return -1; // not up yet
        }
        return count;
    }

    private static Map<String, TreeSet<String>> documents(MongoProcess mongo) {
        Map<String, TreeSet<String>> all = new TreeMap<>();
        try (MongoClient client = reader(mongo).open()) {
            MissionCollections collections = collections(client);
            for (String name : collections.names()) {
                TreeSet<String> documents = new TreeSet<>();
                for (RawBsonDocument document : collections.get(name).find()) {
                    documents.add(new String(document.getByteBuffer().array(), ISO_8859_1));
                }
                all.put(name, documents);
            }
        }
        return all;
    }

    private static MissionCollections collections(MongoClient client) {
        return new MissionCollections(client, Retention.FOR_EVER, Clock.systemUTC());
    }

    private static MongoAccess reader(MongoProcess mongo) {
        return new MongoAccess(mongo.uri(), MongoAccess.Waits.of(Duration.ZERO));
    }
}
