package io.furrow.ingest;

import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.JobID;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.EnabledIfSystemProperty;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * Savepoints of released states of the job, each restored by what the job is now. A new one is written, with the release's
 * name as folder, by
 *
 * <pre>./mvnw -pl ingest -am verify -Dtest=none -Dit.test=StoredSavepointIT -Dfurrow.savepoint=0.2.0
 *     -Dsurefire.failIfNoSpecifiedTests=false -Dfailsafe.failIfNoSpecifiedTests=false</pre>
 *
 * <p>One that is stored is never written again.
 */
@Timeout(120)
class StoredSavepointIT {
    private static final Path STORED = Path.of("src/test/resources/savepoints");
    private static final long TIME = 1_700_000_000_000L;

    @TempDir
    Path directory;

    private KafkaSuite suite;

    @BeforeEach
    void start() throws Exception {
        suite = KafkaSuite.start(directory.resolve("kafka"));
        suite.makeTopic(Topics.RAW, 1);
        suite.makeTopic(Topics.DEVICES, 1);
    }

    @AfterEach
    void stop() {
        suite.close();
    }

    @ParameterizedTest
    @ValueSource(strings = "0.1.0")
    void isRestoredWithAllThatItKnew(String release) throws Exception {
        reportBeforeTheSavepoint(); // offsets are as they were, nothing of it is read again
        suite.write(Topics.DEVICES, 0, TIME, "|/|robot", null, Map.of());
        reportAfterTheSavepoint();

        JobID job =
                suite.run(STORED.resolve(release).toUri().toString(), "--parallelism", "1", "--topic-partitions", "1");
        List<ConsumerRecord<byte[], byte[]>> farm = suite.awaitRecords("data.farm.realtime", 3);
        List<ConsumerRecord<byte[], byte[]>> latest = suite.awaitRecords(Topics.LATEST, 4);
        suite.cancel(job);

        assertThat(told(farm))
                .as("the repeat is known, the deletion goes where the thermometer was, the robot's history is kept")
                .containsExactly("update camera", "gone thermometer", "before robot");
        assertThat(told(suite.awaitRecords("data.farm.realtime.weeding", 3)))
                .containsExactly("update camera", "gone thermometer", "before robot");
        Entity camera = Entity.parse(latest.get(0).value());
        assertThat(camera.number("Latitude")).as("from the state").contains(40.0);
        assertThat(camera.number("Longitude")).contains(-3.0);
        assertThat(latest).extracting(ConsumerRecord::value).element(1).isNull();
    }

    @Test
    @EnabledIfSystemProperty(named = "furrow.savepoint", matches = "[0-9.]+")
    void isWritten() throws Exception {
        Path target = STORED.resolve(System.getProperty("furrow.savepoint"));
        assertThat(target).doesNotExist();
        reportBeforeTheSavepoint();
        JobID job = suite.run(null, "--parallelism", "1", "--topic-retention", "36500d");
        suite.awaitRecords("data.farm.realtime.weeding", 3);

        String savepoint = suite.stop(job, directory.resolve("savepoints"));

        Path written = Path.of(java.net.URI.create(savepoint));
        try (var files = Files.list(written)) {
            assertThat(files).as("small enough to be one file").containsExactly(written.resolve("_metadata"));
        }
        Files.createDirectories(target);
        Files.copy(written.resolve("_metadata"), target.resolve("_metadata"));
    }

    private void reportBeforeTheSavepoint() {
        DeviceVersion robot = new DeviceVersion("robot", "", "/", "farm", "weeding", 0, null, 1, null);
        suite.write(Topics.DEVICES, 0, 0, robot.key(), new String(robot.toBytes(), StandardCharsets.UTF_8), Map.of());
        report(TIME, "first", "camera", attribute("Latitude", "40") + "," + named());
        report(TIME, "first", "thermometer", named());
        report(TIME, "first", "robot", attribute("n", "1"));
    }

    private void reportAfterTheSavepoint() {
        report(TIME, "first", "camera", attribute("Latitude", "40") + "," + named());
        report(TIME + 1, "update", "camera", attribute("Longitude", "-3") + "," + named());
        suite.write(Topics.RAW, 0, TIME + 1, "thermometer", null, Map.of(HeaderNames.CE_ID, "gone"));
        report(TIME - 1, "before", "robot", attribute("m", "0"));
        report(TIME + 1, "after", "robot", attribute("n", "2"));
    }

    private void report(long time, String id, String entity, String attributes) {
        String value = "{'id':'" + entity + "','type':'T'," + attributes + "}";
        suite.write(Topics.RAW, 0, time, entity, value.replace('\'', '"'), Map.of(HeaderNames.CE_ID, id));
    }

    private static String named() {
        return attribute("Domain", "'farm'") + "," + attribute("Mission", "'weeding'");
    }

    private static String attribute(String name, String value) {
        return "'" + name + "':{'type':'X','value':" + value + ",'metadata':{}}";
    }

    private static List<String> told(List<ConsumerRecord<byte[], byte[]>> records) {
        List<String> told = new ArrayList<>();
        records.forEach(record -> told.add(KafkaSuite.headers(record).get(HeaderNames.CE_ID) + " "
                + new String(record.key(), StandardCharsets.UTF_8)));
        return told;
    }
}
