package io.furrow.control;

import java.time.Duration;
import java.util.List;
import java.util.stream.IntStream;

import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.control.replay.ReplaySettings;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;

import static io.furrow.control.ManagerFixture.error;
import static io.furrow.control.ManagerFixture.response;
import static io.furrow.control.ManagerFixture.text;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ReplayTopologyTest {
    @AutoClose
    private final ManagerFixture farm = new ManagerFixture();

    @Test
    void publishesReplaysAndRemovesThemOnceTheyAreOver() throws Exception {
        farm.request(
                Topics.REPLAY_MANAGER, "'command':'start','mission':'m','speed':'max','from':1000,'devices':['urn:x']");
        CommandResult created = response(farm.only(Topics.REPLAY_MANAGER));
        String replay = created.json().path("replay").asText();
        assertThat(replay).matches("m\\.[0-9a-f]{8}");
        assertThat(created.json().path("topic").asText()).isEqualTo("data.m.replay." + replay.substring(2));

        for (String command : List.of("step", "pause", "step", "step", "seek", "resume", "resume", "stop", "stop")) {
            farm.request(Topics.REPLAY_MANAGER, "'command':'" + command + "','to':5000,'replay':'" + replay + "'");
        }
        assertThat(farm.read(Topics.REPLAY_MANAGER))
                .extracting(record ->
                        response(record).error().orElse(response(record).status()))
                .containsExactly("""
                                wrong-state paused paused paused paused running wrong-state deleted wrong-state""".split("\\s+"));
        List<TestRecord<String, byte[]>> desired = farm.read(Topics.REPLAYS);
        assertThat(text(desired.get(desired.size() - 1).value()))
                .contains("\"from\":1000,", "\"speed\":\"max\"", "\"wanted\":\"stopped\"")
                .contains("\"seek\":{\"to\":5000,\"sequence\":5},\"step\":{\"total\":2,\"sequence\":4}")
                .endsWith("\"sequence\":7}");

        farm.pipe(Topics.REPLAYS_STATUS, replay, "{\"sequence\":6,\"state\":\"ended\"}".getBytes(UTF_8));
        farm.pipe(
                Topics.REPLAYS_STATUS,
                replay,
                "{\"sequence\":7,\"state\":\"stopped\",\"settled\":false}".getBytes(UTF_8));
        assertThat(farm.read(Topics.REPLAYS)).as("older, or not settled").isEmpty();
        farm.pipe(Topics.REPLAYS_STATUS, replay, "{\"sequence\":7,\"state\":\"stopped\"}".getBytes(UTF_8));
        assertThat(farm.only(Topics.REPLAYS).value()).isNull();
        farm.request(Topics.REPLAY_MANAGER, "'command':'stop','replay':'" + replay + "'");
        assertThat(error(farm.only(Topics.REPLAY_MANAGER))).isEqualTo("unknown-replay");
    }

    @Test
    void limitsTheNumberOfReplays() {
        List<String> replays = IntStream.range(0, ReplaySettings.DEFAULT.max() - 1)
                .mapToObj(number -> startReplay(""))
                .toList();
        String group = "{'type':'request','command':'start','missions':['a','b'],'from':1000,'to':9000}";
        farm.request(Topics.REPLAY_MANAGER, null, group);
        CommandResult rejected = response(farm.only(Topics.REPLAY_MANAGER));
        assertThat(rejected.error()).contains("quota-exceeded");
        assertThat(rejected.json().path("reason").asText())
                .isEqualTo(
                        "255 replays are not over, of at most 256 (--max-replays); stop one that is not needed any more");

        report(replays.get(0), 1, ReplayStatus.State.ENDED, false);
        farm.request(Topics.REPLAY_MANAGER, null, group);

        assertThat(response(farm.only(Topics.REPLAY_MANAGER)).status()).isEqualTo("created");
    }

    @Test
    void retainsAnEndedReplayForAnHour() {
        String replay = startReplay("");
        report(replay, 1, ReplayStatus.State.ENDED, false);
        report(replay, 1, ReplayStatus.State.ENDED, true);
        farm.pass(Duration.ofMinutes(50));
        report(replay, 1, ReplayStatus.State.ENDED, true); // by a restarted job
        farm.pass(Duration.ofMinutes(9));
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();

        assertThat(steer(replay, "'seek','to':5000").status()).isEqualTo("running");
        assertThat(text(farm.only(Topics.REPLAYS).value())).contains("\"seek\":{\"to\":5000,\"sequence\":2}");
        farm.pass(Duration.ofMinutes(61));
        assertThat(farm.read(Topics.REPLAYS)).as("seek not played yet").isEmpty();
        report(replay, 2, ReplayStatus.State.RUNNING, false);
        report(replay, 2, ReplayStatus.State.ENDED, true);
        farm.pass(Duration.ofMinutes(59));
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();
        farm.pass(Duration.ofMinutes(1));

        assertThat(farm.only(Topics.REPLAYS).value()).isNull();
        assertThat(steer(replay, "'seek','to':5000").error()).contains("unknown-replay");
        farm.pass(Duration.ofHours(2));
        assertThat(farm.read(Topics.REPLAYS)).as("removed once").isEmpty();
    }

    @Test
    void stepsAndLoopsAnEndedReplay() {
        String replay = startReplay("");
        report(replay, 1, ReplayStatus.State.ENDED, true);
        assertThat(steer(replay, "'step','count':-3").status()).isEqualTo("paused");
        assertThat(text(farm.only(Topics.REPLAYS).value()))
                .contains("\"wanted\":\"paused\"", "\"step\":{\"total\":-3,\"sequence\":2}");
        assertThat(steer(replay, "'resume'").status()).isEqualTo("running");
        farm.read(Topics.REPLAYS);

        report(replay, 3, ReplayStatus.State.ENDED, true);
        assertThat(steer(replay, "'loop','from':2000,'to':3000").status()).isEqualTo("running");
        assertThat(text(farm.only(Topics.REPLAYS).value()))
                .contains("\"seek\":{\"to\":2000,\"sequence\":4}", "\"range\":{\"from\":2000,\"to\":3000}");
    }

    @Test
    void checksCommandsAgainstTheReportedState() {
        String replay = startReplay("");
        report(replay, 1, ReplayStatus.State.ENDED, false);
        for (String command : List.of("'pause'", "'resume'", "'step'", "'step','count':2")) {
            CommandResult rejected = steer(replay, command);
            assertThat(rejected.error()).as(command).contains("wrong-state");
            assertThat(rejected.json().path("reason").asText()).contains("is ended", "'seek'");
        }
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();
        assertThat(steer(replay, "'speed','speed':5").status()).isEqualTo("changed");
        report(replay, 2, ReplayStatus.State.FAILED, false);
        for (String command : List.of("'pause'", "'resume'", "'step','count':-1")) {
            assertThat(steer(replay, command).error()).as(command).contains("wrong-state");
        }
        assertThat(steer(replay, "'stop'").status()).isEqualTo("deleted");
        report(replay, 3, ReplayStatus.State.STOPPED, true);
        assertThat(farm.read(Topics.REPLAYS))
                .hasSize(3)
                .last()
                .extracting(TestRecord::value)
                .isNull();
    }

    @Test
    void removesAReplayThatFinallyFailed() {
        String replay = startReplay("");
        report(replay, 1, ReplayStatus.State.FAILED, true);
        assertThat(farm.only(Topics.REPLAYS).value()).isNull();
    }

    @Test
    void rejectsASeekOutsideOfThePlayedRange() {
        String whole = startReplay("");
        assertThat(steer(whole, "'seek','to':99000").error())
                .as("unknown recording")
                .isEmpty();
        farm.pipe(Topics.RECORDINGS, "m", new RecordedMission("m", 1000, 5000, 5).toBytes());
        assertThat(steer(whole, "'seek','to':9000").error())
                .as("running mission, later than listed")
                .isEmpty();
        report(whole, 3, ReplayStatus.State.RUNNING, false);
        String part = startReplay(",'from':2000,'to':8000");
        report(part, 4, ReplayStatus.State.RUNNING, false);
        farm.read(Topics.REPLAYS);

        for (String outside : List.of("999", "9001")) {
            CommandResult rejected = steer(whole, "'seek','to':" + outside);
            assertThat(rejected.error()).as(outside).contains("wrong-member");
            assertThat(rejected.json().path("reason").asText())
                    .containsAnyOf("at least 1970-01-01T00:00:01Z", "at most 1970-01-01T00:00:09Z");
        }
        for (String outside : List.of("1999", "8000")) {
            assertThat(steer(part, "'seek','to':" + outside).error())
                    .as(outside)
                    .contains("wrong-member");
        }
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();
        for (String inside : List.of("1000", "9000")) {
            assertThat(steer(whole, "'seek','to':" + inside).error()).isEmpty();
        }
        for (String inside : List.of("2000", "7999")) {
            assertThat(steer(part, "'seek','to':" + inside).error()).isEmpty();
        }
    }

    private String startReplay(String members) {
        farm.request(Topics.REPLAY_MANAGER, "'command':'start','mission':'m'" + members);
        String replay =
                response(farm.only(Topics.REPLAY_MANAGER)).json().path("replay").asText();
        farm.read(Topics.REPLAYS);
        return replay;
    }

    private CommandResult steer(String replay, String command) {
        farm.request(Topics.REPLAY_MANAGER, "'replay':'" + replay + "','command':" + command);
        return response(farm.only(Topics.REPLAY_MANAGER));
    }

    /** Reports a state of a replay whose recording lasts from 1 s to 9 s. */
    private void report(String replay, long sequence, ReplayStatus.State state, boolean settled) {
        String status = """
                {"sequence":%d,"state":"%s","settled":%s,"progress":{"position":9000,"from":1000,"to":9000}}""".formatted(sequence, state.code(), settled);
        farm.pipe(Topics.REPLAYS_STATUS, replay, status.getBytes(UTF_8));
    }
}
