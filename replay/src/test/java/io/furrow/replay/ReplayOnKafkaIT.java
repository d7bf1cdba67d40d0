package io.furrow.replay;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.mission.StoredEvent;
import io.furrow.mission.file.ArchiveLine;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static io.furrow.replay.ReplaySuite.TIME;
import static io.furrow.replay.ReplaySuite.desired;
import static io.furrow.replay.ReplaySuite.header;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(240)
class ReplayOnKafkaIT {
    /** Additional time without MongoDB after the status reports it; set by {@code -Dfurrow.test.mongo-away=SECONDS}. */
    private static final Duration MONGO_AWAY = Duration.ofSeconds(Long.getLong("furrow.test.mongo-away", 0));

    @TempDir
    Path directory;

    @AutoClose
    private ReplaySuite suite;

    @BeforeEach
    void start() throws Exception {
        suite = ReplaySuite.start(directory);
    }

    private void awaitStatus(String mission, State state, long sequence) {
        await().until(() -> {
            ReplayStatus status = suite.status(mission);
            return status != null && status.state() == state && status.sequence() == sequence;
        });
    }

    private List<ConsumerRecord<byte[], byte[]>> played(String mission, String epoch, String kind) {
        return suite.records(Topics.replay(mission, "0a1b2c3d")).stream()
                .filter(record -> header(record, HeaderNames.REPLAY_EPOCH).equals(epoch))
                .filter(record -> header(record, HeaderNames.REPLAY_KIND).equals(kind))
                .toList();
    }

    private List<Integer> numbers(String mission) {
        return suite.records(Topics.replay(mission, "0a1b2c3d")).stream()
                .filter(record -> header(record, HeaderNames.REPLAY_KIND).equals("event"))
                .map(record -> Integer.valueOf(header(record, HeaderNames.REPLAY_SEQUENCE)))
                .sorted()
                .toList();
    }

    private static List<Integer> all(int count) {
        return IntStream.range(0, count).boxed().toList();
    }

    @Test
    void pausesSeeksAndChangesSpeed() throws Exception {
        suite.store("m", 100, 1_000);
        suite.run(null, "--parallelism", "2");
        suite.publish(desired("m", 1, State.RUNNING, 1));
        await().until(() -> suite.status("m") != null
                && suite.status("m").progress() != null
                && suite.status("m").progress().events() > 0);
        suite.publish(desired("m", 1, State.PAUSED, 2));
        awaitStatus("m", State.PAUSED, 2);

        DesiredReplay sought = seeking(desired("m", 1, State.PAUSED, 3), TIME + 50_000);
        suite.publish(sought);
        awaitStatus("m", State.PAUSED, 3);
        await().until(() -> played("m", "1", "prime").size() == 4);
        suite.publish(seeking(desired("m", ReplayCommand.MAX, State.RUNNING, 4), TIME + 50_000));
        await().until(() -> {
            ReplayStatus status = suite.status("m");
            return status.state() == State.ENDED && status.settled() && status.sequence() == 4;
        });

        assertThat(played("m", "0", "end"))
                .as("of the epoch before the jump, on every partition")
                .hasSize(3);
        assertThat(played("m", "1", "end"))
                .extracting(ConsumerRecord::partition)
                .containsExactlyInAnyOrder(0, 1, 2);
        List<ConsumerRecord<byte[], byte[]>> events = played("m", "1", "event");
        assertThat(events).hasSize(50);
        assertThat(events).extracting(record -> header(record, "ce_source")).containsOnly("/test");
        assertThat(played("m", "1", "prime"))
                .extracting(record -> header(record, HeaderNames.REPLAY_TIME))
                .containsOnly(java.time.Instant.ofEpochMilli(TIME + 50_000).toString());
        assertThat(suite.status("m").progress().events()).isEqualTo(50);
        assertThat(suite.status("m").progress().primes()).isEqualTo(4);
    }

    private static DesiredReplay seeking(DesiredReplay last, long to) {
        return last.seeking(to, 3).desired(last.desired(), last.sequence());
    }

    @Tag("full")
    @Test
    void stepsBackAndRepeatsARange() throws Exception {
        suite.store("m", 100, 1_000);
        suite.run(null, "--parallelism", "1", "--page-events", "7");
        DesiredReplay paused = desired("m", 1, State.PAUSED, 1).stepping(20, 1);
        suite.publish(paused);
        await().until(() -> played("m", "0", "event").size() == 20);

        suite.publish(paused.stepping(-5, 2));
        await().until(() -> played("m", "1", "event").size() == 1);
        assertThat(header(played("m", "1", "event").get(0), HeaderNames.REPLAY_CE_ID))
                .isEqualTo("e00014");
        assertThat(played("m", "1", "prime")).hasSize(4);
        suite.publish(paused.stepping(-5, 2)
                .within(new DesiredReplay.Range(TIME + 30_000, TIME + 33_000), 3)
                .at(ReplayCommand.MAX, 3)
                .desired(State.RUNNING, 3));

        await().until(() -> played("m", "3", "event").size() == 3);
        assertThat(ids("m", "2")).containsExactly("e00030", "e00031", "e00032");
        assertThat(ids("m", "3")).containsExactly("e00030", "e00031", "e00032");
    }

    private List<String> ids(String mission, String epoch) {
        return played(mission, epoch, "event").stream()
                .map(record -> header(record, HeaderNames.REPLAY_CE_ID))
                .sorted()
                .toList();
    }

    @Tag("full")
    @Test
    void playsFilesAndTopicsAndReportsMissingOnes() throws Exception {
        Path folder = Files.createDirectories(directory.resolve("recordings"));
        StringBuilder lines = new StringBuilder();
        for (StoredEvent event : List.of(event("a", TIME), event("b", TIME + 10), event("c", TIME + 20))) {
            lines.append(ReplaySuite.text(ArchiveLine.write(event))).append('\n');
        }
        Files.writeString(folder.resolve("field.jsonl"), lines);
        suite.run(null, "--parallelism", "1", "--recordings", folder.toUri().toString());

        suite.publish(of("m", new ReplayPlan.Source(null, "field.jsonl")));
        suite.publish(of("n", new ReplayPlan.Source(null, "none.jsonl")));
        suite.publish(of("o", new ReplayPlan.Source("data.none", null)));

        awaitStatus("n", State.FAILED, 1);
        assertThat(suite.status("n").reason()).contains("no file 'none.jsonl'");
        awaitStatus("m", State.ENDED, 1);
        await().until(() -> ids("m", "0").equals(List.of("a", "b", "c")));
        awaitStatus("o", State.FAILED, 1);
        assertThat(suite.status("o").reason()).contains("no topic 'data.none'");

        suite.publish(of("p", new ReplayPlan.Source(Topics.replay("m", "0a1b2c3d"), null)));
        awaitStatus("p", State.ENDED, 1);
        await().until(() -> played("p", "0", "event").size() >= 3);
        assertThat(played("p", "0", "event"))
                .extracting(record -> header(record, HeaderNames.REPLAY_TIME))
                .startsWith(java.time.Instant.ofEpochMilli(TIME).toString());
    }

    private static StoredEvent event(String id, long time) {
        return new StoredEvent(
                id,
                time,
                "urn:d0",
                Map.of(),
                JsonNodeFactory.instance.objectNode().put("id", "urn:d0").put("type", "T"));
    }

    private static DesiredReplay of(String mission, ReplayPlan.Source source) {
        ReplayPlan plan =
                new ReplayPlan(source, null, null, false, List.of(), null, ReplayPlan.Stamps.ORIGINAL, null, List.of());
        return DesiredReplay.started(
                mission, Topics.replay(mission, "0a1b2c3d"), plan, 1, System.currentTimeMillis(), 1);
    }

    @Tag("full")
    @Test
    void losesAndDuplicatesNothingWhenItIsKilledAndRescaled() throws Exception {
        List<String> missions = List.of("a", "b", "c");
        for (String mission : missions) {
            suite.store(mission, 1_500, 10);
            suite.publish(desired(mission, 1, State.RUNNING, 1));
        }
        JobID job = suite.run(null, "--parallelism", "1", "--delivery", "exactly-once");
        await().until(() ->
                suite.status("a") != null && suite.status("a").progress().events() > 200);

        suite.flink().cluster().terminateTaskManager(0).get();
        suite.flink().cluster().startTaskManager();
        await().until(() -> suite.flink().status(job) == JobStatus.RUNNING);
        await().until(() -> suite.status("a").progress().events() > 400);
        assertThat(suite.status("a").state()).isEqualTo(State.RUNNING);
        String savepoint = suite.stop(job, directory.resolve("savepoints"));
        suite.run(savepoint, "--parallelism", "3", "--delivery", "exactly-once");

        for (String mission : missions) {
            await().until(() ->
                    suite.status(mission).settled() && suite.status(mission).state() == State.ENDED);
            // a commit is acknowledged before its markers are on every partition
            await().untilAsserted(() -> assertThat(numbers(mission)).as(mission).isEqualTo(all(1_500)));
            await().untilAsserted(() -> assertThat(played(mission, "0", "end")).hasSize(3));
        }
    }

    @Tag("full")
    @Test
    void failsWhenItsTopicIsDeletedAndDelaysNoOther() throws Exception {
        for (String mission : List.of("m", "other")) {
            suite.store(mission, 400, 100);
            suite.publish(desired(mission, 1, State.RUNNING, 1));
        }
        suite.run(null, "--parallelism", "1");
        for (String mission : List.of("m", "other")) {
            await().until(() -> suite.status(mission) != null
                    && suite.status(mission).progress().events() > 20);
        }

        suite.delete(Topics.replay("m", "0a1b2c3d"));

        awaitStatus("m", State.FAILED, 1);
        assertThat(suite.status("m").reason()).isEqualTo("its topic was deleted while it was played");
        await("its end, on the topic that was created again")
                .until(() -> !played("m", "0", "end").isEmpty());
        ReplayStatus other = suite.status("other");
        assertThat(other.state()).isEqualTo(State.RUNNING);
        assertThat(other.progress().slipMillis()).isZero();
        suite.publish(desired("other", ReplayCommand.MAX, State.RUNNING, 2));
        awaitStatus("other", State.ENDED, 2);
        await().untilAsserted(() -> assertThat(numbers("other")).isEqualTo(all(400)));
    }

    @Tag("full")
    @Test
    void waitsForMongoAndFailsUnknownMissions() throws Exception {
        suite.store("m", 400, 100);
        suite.run(null, "--parallelism", "1", "--page-events", "20");
        suite.publish(desired("unknown", 1, State.RUNNING, 1));
        awaitStatus("unknown", State.FAILED, 1);
        suite.publish(desired("m", 1, State.RUNNING, 1));
        await().until(() ->
                suite.status("m") != null && suite.status("m").progress().events() > 20);

        suite.stopMongo();
        await().until(() -> suite.status("m").progress().waiting() != null);
        await().pollDelay(MONGO_AWAY).atMost(MONGO_AWAY.plusMinutes(1)).untilAsserted(() -> {
            assertThat(suite.status("m").state()).isEqualTo(State.RUNNING);
            assertThat(suite.status("m").progress().waiting()).isNotNull();
        });
        suite.startMongo();
        suite.publish(desired("m", ReplayCommand.MAX, State.RUNNING, 2));

        awaitStatus("m", State.ENDED, 2);
        await().untilAsserted(() -> assertThat(numbers("m")).isEqualTo(all(400)));
    }
}
