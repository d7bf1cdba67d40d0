package io.furrow.ingest;

import java.nio.file.Path;
import java.util.List;
import java.util.Map;

import com.mongodb.MongoCommandException;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.TopicPartition;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(240)
@Tag("full")
class DividedIngestIT {
    @TempDir
    static Path directory;

    private static final long TIME = System.currentTimeMillis() - 60_000;

    @AutoClose
    private static KafkaSuite suite;

    @BeforeAll
    static void start() {
        suite = KafkaSuite.start(directory.resolve("kafka"));
    }

    @Test
    void stopsOnlyThePartWhoseStoreIsAway() throws Exception {
        int port = FreePort.orFree(0);
        String mongo = "mongodb://127.0.0.1:" + port;
        suite.makeTopic("in-away", 1);
        report("in-away", 0, 100, "away");

        JobID missions = run(
                "in-away",
                null,
                "missions",
                "--mongo",
                mongo + "/?serverSelectionTimeoutMS=200",
                "--mongo-retry-timeout",
                "1s");
        JobID others = run("in-away", null, "routes,latest");
        suite.awaitRecords("data.away.realtime.m", 100);
        await().until(() -> suite.status(missions) == JobStatus.RESTARTING);
        report("in-away", 100, 200, "away");

        assertThat(KafkaSuite.ids(suite.awaitRecords("data.away.realtime.m", 200)))
                .hasSize(200);
        await().until(() -> newest("away").size() >= 200);
        assertThat(suite.status(others)).isEqualTo(JobStatus.RUNNING);
        try (EmbeddedMongo server = EmbeddedMongo.start(directory.resolve("mongo"), port);
                MongoClient client = MongoClients.create(mongo)) {
            await().ignoreExceptionsInstanceOf(MongoCommandException.class) // the stand-in cannot count what grows
                    .until(() -> client.getDatabase("persistence")
                                    .getCollection("mission_m")
                                    .countDocuments()
                            == 200);
            suite.cancel(missions);
            suite.cancel(others);
            assertThat(server.uri()).isEqualTo(mongo);
        }
    }

    @Test
    void goesOnInPartsFromASavepointOfTheWhole() throws Exception {
        suite.makeTopic("in-parted", 2);
        report("in-parted", 0, 500, "parted");
        JobID whole = suite.run(null, "--input", "in-parted", "--parallelism", "1", "--topic-partitions", "1");
        suite.awaitRecords("data.parted.realtime", 200);
        String savepoint = suite.stop(whole, directory.resolve("savepoints"));
        report("in-parted", 250, 1000, "parted"); // some are repeated, of which only state knows

        JobID routes = run("in-parted", savepoint, "routes");
        JobID latest = run("in-parted", savepoint, "latest");
        List<ConsumerRecord<byte[], byte[]>> routed = suite.awaitRecords("data.parted.realtime", 1000);
        await().until(() -> newest("parted").contains("parted999"));
        report("in-parted", 1000, 1001, "parted"); // comes behind whatever might have come too often
        suite.awaitRecords("data.parted.realtime", 1001);
        await().until(() -> newest("parted").contains("parted1000"));
        suite.cancel(routes);
        suite.cancel(latest);

        assertThat(KafkaSuite.ids(routed)).hasSize(1000).hasSameSizeAs(routed);
        assertThat(suite.awaitRecords("data.parted.realtime", 1001)).hasSize(1001);
        assertThat(newest("parted")).doesNotHaveDuplicates().hasSize(1001);
    }

    private static JobID run(String input, String savepoint, String parts, String... more) {
        String[] arguments = java.util.Arrays.copyOf(more, more.length + 8);
        List<String> own = List.of("--input", input, "--parallelism", "1", "--topic-partitions", "1", "--parts", parts);
        for (int i = 0; i < own.size(); i++) {
            arguments[more.length + i] = own.get(i);
        }
        return suite.run(savepoint, arguments);
    }

    /** The ids of the events that made records of {@code data.latest}. */
    private static List<String> newest(String domain) throws Exception {
        suite.awaitRecords("data.latest", 1);
        TopicPartition only = new TopicPartition("data.latest", 0);
        int all = (int) suite.admin()
                .listOffsets(Map.of(only, OffsetSpec.latest()))
                .partitionResult(only)
                .get()
                .offset();
        return suite.awaitRecords("data.latest", all).stream()
                .filter(record -> new String(record.key(), UTF_8).startsWith(domain))
                .map(record -> KafkaSuite.headers(record).get(HeaderNames.CE_ID))
                .toList();
    }

    private static void report(String topic, int from, int to, String domain) {
        for (int number = from; number < to; number++) {
            String id = domain + "-t" + number % 20;
            String entity = ("{'id':'" + id + "','type':'T','Domain':{'type':'Text','value':'" + domain
                            + "','metadata':{}},'Mission':{'type':'Text','value':'m','metadata':{}},'n':{'type':'Number','value':"
                            + number + ",'metadata':{}}}")
                    .replace('\'', '"');
            suite.write(topic, null, TIME + number, id, entity, Map.of(HeaderNames.CE_ID, domain + number));
        }
    }
}
