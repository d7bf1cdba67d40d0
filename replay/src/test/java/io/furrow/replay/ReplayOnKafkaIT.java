package io.furrow.replay;

import java.nio.file.Path;
import java.util.List;
import java.util.stream.IntStream;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.control.WantedReplay;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static io.furrow.replay.ReplaySuite.TIME;
import static io.furrow.replay.ReplaySuite.header;
import static io.furrow.replay.ReplaySuite.wanted;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(240)
class ReplayOnKafkaIT {
    @TempDir
    Path directory;

    private ReplaySuite suite;

    @BeforeEach
    void start() throws Exception {
        suite = ReplaySuite.start(directory);
    }

    @AfterEach
    void stop() {
        suite.close();
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
    void doesWhatItIsTold() throws Exception {
        suite.store("m", 100, 1_000);
        suite.run(null, "--parallelism", "2");
        suite.want(wanted("m", 1, State.RUNNING, 1));
        await().until(() -> suite.status("m") != null
                && suite.status("m").progress() != null
                && suite.status("m").progress().events() > 0);
        suite.want(wanted("m", 1, State.PAUSED, 2));
        awaitStatus("m", State.PAUSED, 2);

        WantedReplay sought = seeking(wanted("m", 1, State.PAUSED, 3), TIME + 50_000);
        suite.want(sought);
        awaitStatus("m", State.PAUSED, 3);
        await().until(() -> played("m", "1", "prime").size() == 4);
        suite.want(seeking(wanted("m", ReplayCommand.MAX, State.RUNNING, 4), TIME + 50_000));
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

    private static WantedReplay seeking(WantedReplay w, long to) {
        return new WantedReplay(
                w.replay(),
                w.mission(),
                w.topic(),
                w.from(),
                w.to(),
                w.speed(),
                w.loop(),
                w.devices(),
                w.wanted(),
                new WantedReplay.Seek(to, 3),
                null,
                w.sequence());
    }

    @Tag("full")
    @Test
    void leavesNoGapAndDoublesNothingWhereItIsKilledAndMoved() throws Exception {
        List<String> missions = List.of("a", "b", "c");
        for (String mission : missions) {
            suite.store(mission, 1_500, 10);
            suite.want(wanted(mission, 1, State.RUNNING, 1));
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
            assertThat(numbers(mission)).as(mission).isEqualTo(all(1_500));
            assertThat(played(mission, "0", "end")).hasSize(3);
        }
    }

    @Tag("full")
    @Test
    void waitsForMongoAndFailsWhatIsUnknown() throws Exception {
        suite.store("m", 400, 100);
        suite.run(null, "--parallelism", "1", "--page-events", "20");
        suite.want(wanted("unknown", 1, State.RUNNING, 1));
        awaitStatus("unknown", State.FAILED, 1);
        suite.want(wanted("m", 1, State.RUNNING, 1));
        await().until(() ->
                suite.status("m") != null && suite.status("m").progress().events() > 20);

        suite.stopMongo();
        await().until(() -> suite.status("m").progress().waiting() != null);
        assertThat(suite.status("m").state()).isEqualTo(State.RUNNING);
        suite.startMongo();
        suite.want(wanted("m", ReplayCommand.MAX, State.RUNNING, 2));

        awaitStatus("m", State.ENDED, 2);
        assertThat(numbers("m")).isEqualTo(all(400));
    }
}
