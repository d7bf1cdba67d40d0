package io.furrow.ingest;

import java.nio.file.Path;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.JobID;
import org.apache.kafka.clients.admin.Config;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.config.ConfigResource;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Timeout(180)
class IngestOnKafkaIT {
    @TempDir
    static Path directory;

    /** Not long ago: the broker's retention goes by the record timestamp. */
    private static final long TIME = System.currentTimeMillis() - 60_000;

    private static final String WHOLE = "{\"id\":\"whole\",\"type\":\"T\",%s}";
    private static final String ONE = "{\"type\":\"Number\",\"value\":1,\"metadata\":{}}";
    private static final String TWO = "{\"type\":\"Number\",\"value\":2,\"metadata\":{}}";

    @AutoClose
    private static KafkaSuite suite;

    @BeforeAll
    static void start() {
        suite = KafkaSuite.start(directory.resolve("kafka"));
    }

    @Tag("full")
    @Test
    void makesTopicsWithTheConfiguredPartitionsReplicationAndRetention() throws Exception {
        suite.makeTopic("in-topics", 1);
        report("in-topics", 1, "tall");

        JobID job = suite.run(
                null,
                "--input",
                "in-topics",
                "--parallelism",
                "1",
                "--topic-partitions",
                "3",
                "--topic-replication",
                "1",
                "--topic-retention",
                "7d");
        suite.awaitRecords("data.tall.realtime.m", 1);
        suite.awaitRecords("data.latest", 1);
        suite.cancel(job);

        assertThat(suite.admin()
                        .describeTopics(List.of("data.tall.realtime.m"))
                        .allTopicNames()
                        .get()
                        .get("data.tall.realtime.m")
                        .partitions())
                .hasSize(3)
                .allSatisfy(partition -> assertThat(partition.replicas()).hasSize(1));
        assertThat(config("data.tall.realtime.m").get("retention.ms").value()).isEqualTo("604800000");
        assertThat(config("data.tall.realtime.m").get("cleanup.policy").value()).isEqualTo("delete");
        assertThat(config("data.latest").get("cleanup.policy").value()).isEqualTo("compact");
    }

    @Tag("full")
    @Test
    void awaitsWhatIsKnownOfDevicesBeforeTheFirstEvent() throws Exception {
        suite.makeTopic("in-devices", 1);
        suite.makeTopic("own.devices", 2);
        for (int sequence = 1; sequence <= 500; sequence++) {
            var version = new DeviceVersion("robot", "", "/", "d" + sequence, "", sequence, null, sequence, null);
            suite.write("own.devices", null, sequence, version.key(), new String(version.toBytes(), UTF_8), Map.of());
        }
        suite.write("in-devices", null, TIME, "robot", "{\"id\":\"robot\",\"type\":\"ROBOT\"}", Map.of());

        JobID job = suite.run(null, "--input", "in-devices", "--devices", "own.devices", "--parallelism", "2");

        assertThat(suite.awaitRecords("data.d500.realtime", 1)).hasSize(1);
        suite.cancel(job);
    }

    @Tag("full")
    @Test
    void beginsWithTheNewestThatIsKnownWhereItHasNoState() throws Exception {
        suite.makeTopic("in-before", 1);
        suite.makeTopic("in-after", 1);
        suite.write(
                "in-before", null, TIME, "whole", WHOLE.formatted("\"n\":%s,\"m\":%s".formatted(ONE, ONE)), Map.of());
        JobID job = suite.run(null, "--input", "in-before", "--parallelism", "1");
        latest("whole", 1);
        suite.cancel(job);

        suite.write("in-after", null, TIME - 1, "whole", WHOLE.formatted("\"m\":" + TWO), Map.of());
        suite.write("in-after", null, TIME + 1, "whole", WHOLE.formatted("\"n\":" + TWO), Map.of());
        job = suite.run(null, "--input", "in-after", "--parallelism", "2");
        List<String> written = latest("whole", 2);
        suite.cancel(job);

        assertThat(written.get(1)).isEqualTo(WHOLE.formatted("\"m\":%s,\"n\":%s".formatted(ONE, TWO)));
    }

    /** What was written of the entity, the newest last. */
    private static List<String> latest(String id, int atLeast) {
        return suite.awaitRecords("data.latest", record -> new String(record.key(), UTF_8).equals(id), atLeast).stream()
                .map(record -> new String(record.value(), UTF_8))
                .toList();
    }

    @Tag("full")
    @ParameterizedTest
    @CsvSource({"at-least-once, hashmap, 1, 2", "exactly-once, rocksdb, 2, 1"})
    void goesOnFromASavepointAtAnotherParallelismWithoutGapOrRepetition(
            String delivery, String backend, String before, String after) throws Exception {
        String in = "in-" + delivery;
        String domain = "d-" + delivery;
        suite.makeTopic(in, 4);
        String[] common = {"--input", in, "--delivery", delivery, "--state-backend", backend, "--unaligned-checkpoints"
        };

        JobID job = suite.run(null, with(common, before));
        report(in, 0, 2000, domain);
        suite.awaitRecords("data." + domain + ".realtime", 500);
        report(in, 2000, 4000, domain);
        String savepoint = suite.stop(job, directory.resolve("savepoints"));
        report(in, 4000, 5000, domain);
        report(in, 1000, 3000, domain); // repeated, some of them not yet read at the savepoint
        job = suite.run(savepoint, with(common, after));
        report(in, 5000, 6000, domain);

        List<ConsumerRecord<byte[], byte[]>> all = suite.awaitRecords("data." + domain + ".realtime", 6000);
        List<ConsumerRecord<byte[], byte[]>> mission = suite.awaitRecords("data." + domain + ".realtime.m", 6000);
        report(in, 6000, 6001, domain); // comes behind whatever might have come too often
        suite.awaitRecords("data." + domain + ".realtime", 6001);
        suite.cancel(job);
        assertThat(KafkaSuite.ids(all)).hasSize(6000).hasSameSizeAs(all);
        assertThat(KafkaSuite.ids(mission)).isEqualTo(KafkaSuite.ids(all)).hasSameSizeAs(mission);
        assertThat(suite.awaitRecords("data." + domain + ".realtime", 6001)).hasSize(6001);
    }

    private static String[] with(String[] common, String parallelism) {
        String[] all = java.util.Arrays.copyOf(common, common.length + 2);
        all[common.length] = "--parallelism";
        all[common.length + 1] = parallelism;
        return all;
    }

    private static void report(String topic, int from, int to, String domain) {
        for (int number = from; number < to; number++) {
            report(topic, number, domain);
        }
    }

    private static void report(String topic, int number, String domain) {
        String entity = ("{'id':'t" + number % 50 + "','type':'T','Domain':{'type':'Text','value':'" + domain
                        + "','metadata':{}},'Mission':{'type':'Text','value':'m','metadata':{}},'n':{'type':'Number','value':"
                        + number + ",'metadata':{}}}")
                .replace('\'', '"');
        suite.write(topic, null, TIME + number, "t" + number % 50, entity, Map.of(HeaderNames.CE_ID, domain + number));
    }

    private static Config config(String topic) throws Exception {
        ConfigResource resource = new ConfigResource(ConfigResource.Type.TOPIC, topic);
        return suite.admin().describeConfigs(List.of(resource)).all().get().get(resource);
    }
}
