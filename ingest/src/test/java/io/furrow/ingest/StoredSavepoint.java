package io.furrow.ingest;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;

import org.apache.flink.api.common.JobID;

import io.furrow.files.Folders;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Stores a savepoint of what the job is now, for every later build to restore; and says what comes before and after it. */
final class StoredSavepoint {
    /** A folder per release, below that of the module. */
    static final Path FOLDER = Path.of("src/test/resources/savepoints");

    private static final long TIME = 1_700_000_000_000L;

    private StoredSavepoint() {}

    /** Argument: the release, which names the folder. One that is stored is never written again. */
    public static void main(String... args) throws Exception {
        Path target = FOLDER.resolve(args[0]);
        if (Files.exists(target)) {
            throw new IllegalStateException(target + " is there already and stays as it is; name another release");
        }
        Path work = Files.createTempDirectory("furrow-savepoint-");
        try (KafkaSuite suite = KafkaSuite.start(work.resolve("kafka"))) {
            store(write(suite, work), target);
        } finally {
            Folders.delete(work);
        }
        System.out.println("stored " + target.toAbsolutePath());
        System.exit(0);
    }

    private static Path write(KafkaSuite suite, Path work) throws Exception {
        makeTopics(suite);
        reportBefore(suite);
        JobID job = suite.run(null, "--parallelism", "1", "--topic-retention", "36500d");
        suite.awaitRecords("data.farm.realtime.weeding", 3);
        return Path.of(URI.create(suite.stop(job, work.resolve("savepoints"))));
    }

    private static void store(Path written, Path target) throws IOException {
        if (Folders.list(written).size() != 1) {
            throw new IllegalStateException("the savepoint should be small enough to be one file: " + written);
        }
        Files.createDirectories(target);
        Files.copy(written.resolve("_metadata"), target.resolve("_metadata"));
    }

    static void makeTopics(KafkaSuite suite) throws Exception {
        suite.makeTopic(Topics.RAW, 1);
        suite.makeTopic(Topics.DEVICES, 1);
    }

    static void reportBefore(KafkaSuite suite) {
        DeviceVersion robot = new DeviceVersion("robot", "", "/", "farm", "weeding", 0, null, 1, null);
        suite.write(Topics.DEVICES, 0, 0, robot.key(), new String(robot.toBytes(), UTF_8), Map.of());
        report(suite, TIME, "first", "camera", attribute("Latitude", "40") + "," + named());
        report(suite, TIME, "first", "thermometer", named());
        report(suite, TIME, "first", "robot", attribute("n", "1"));
    }

    /** A repeat, a change, a deletion, and events of a robot that has left its mission, before and after it did. */
    static void reportAfter(KafkaSuite suite) {
        suite.write(Topics.DEVICES, 0, TIME, "|/|robot", null, Map.of());
        report(suite, TIME, "first", "camera", attribute("Latitude", "40") + "," + named());
        report(suite, TIME + 1, "update", "camera", attribute("Longitude", "-3") + "," + named());
        suite.write(Topics.RAW, 0, TIME + 1, "thermometer", null, Map.of(HeaderNames.CE_ID, "gone"));
        report(suite, TIME - 1, "before", "robot", attribute("m", "0"));
        report(suite, TIME + 1, "after", "robot", attribute("n", "2"));
    }

    private static void report(KafkaSuite suite, long time, String id, String entity, String attributes) {
        String value = "{'id':'" + entity + "','type':'T'," + attributes + "}";
        suite.write(Topics.RAW, 0, time, entity, value.replace('\'', '"'), Map.of(HeaderNames.CE_ID, id));
    }

    private static String named() {
        return attribute("Domain", "'farm'") + "," + attribute("Mission", "'weeding'");
    }

    private static String attribute(String name, String value) {
        return "'" + name + "':{'type':'X','value':" + value + ",'metadata':{}}";
    }
}
