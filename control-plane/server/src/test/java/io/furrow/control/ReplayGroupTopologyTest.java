package io.furrow.control;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.DesiredReplay.Clock;
import io.furrow.model.control.DesiredReplay.Range;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Controls replays of missions a, recorded from 10 s to 60 s, and b, from 20 s to 90 s, which follow a common clock. */
class ReplayGroupTopologyTest {
    private static final long NOW = ManagerFixture.START.toEpochMilli();

    @AutoClose
    private final ManagerFixture farm = new ManagerFixture(true);

    private long sequence;

    private CommandResult request(String members) {
        farm.request(Topics.REPLAY_MANAGER, members);
        return ManagerFixture.response(farm.only(Topics.REPLAY_MANAGER));
    }

    private String start(String members) throws Exception {
        farm.pipe(Topics.RECORDINGS, "a", new RecordedMission("a", 10_000, 60_000, 5).toBytes());
        farm.pipe(Topics.RECORDINGS, "b", new RecordedMission("b", 20_000, 90_000, 5).toBytes());
        CommandResult answer = request("'command':'start','missions':['a','b']" + members);
        assertThat(answer.error()).as(answer.json().toString()).isEmpty();
        return answer.json().path("group").asText();
    }

    /** Returns the desired state of both members after a command; they have the same sequence. */
    private DesiredReplay desired() throws Exception {
        List<DesiredReplay> all = new ArrayList<>();
        for (TestRecord<String, byte[]> record : farm.read(Topics.REPLAYS)) {
            all.add(DesiredReplay.read(record.key(), record.value()));
        }
        assertThat(all).hasSize(2).extracting(DesiredReplay::mission).containsExactly("a", "b");
        DesiredReplay one = all.get(0);
        assertThat(all).allSatisfy(each -> {
            assertThat(each.clock()).isEqualTo(one.clock());
            assertThat(each.sequence()).isEqualTo(one.sequence()).isGreaterThan(sequence);
            assertThat(each.desired()).isEqualTo(one.desired());
            assertThat(each.seek()).isEqualTo(one.seek());
            assertThat(each.range()).isEqualTo(one.range());
            assertThat(each.speed()).isEqualTo(one.speed());
        });
        sequence = one.sequence();
        return one;
    }

    private DesiredReplay steered(String group, String command, String status) throws Exception {
        CommandResult answer = request("'group':'" + group + "','command':" + command);
        assertThat(answer.json().path("status").asText())
                .as(answer.json().toString())
                .isEqualTo(status);
        assertThat(answer.json().path("group").asText()).isEqualTo(group);
        assertThat(answer.json().path("replays")).hasSize(2);
        return desired();
    }

    @Test
    void startsAllMembersOverTheUnionOfTheirRecordings() throws Exception {
        String group = start("");

        assertThat(group).matches("[0-9a-f]{8}");
        DesiredReplay one = desired();
        assertThat(one.replay()).isEqualTo("a." + group);
        assertThat(one.topic()).isEqualTo("data.a.replay." + group);
        assertThat(one.group()).isEqualTo(group);
        assertThat(one.plan().from()).isEqualTo(10_000);
        assertThat(one.plan().to()).isEqualTo(90_001);
        assertThat(one.clock()).isEqualTo(new Clock(NOW + 2000, 10_000));
    }

    @Test
    void returnsTheNamesAndTopicsOfItsMembers() throws Exception {
        start("");
        CommandResult answer =
                request("'command':'start','missions':['b','a'],'from':30000,'range':{'from':40000,'to':50000},"
                        + "'startAt':" + (NOW + 60_000));

        String group = answer.json().path("group").asText();
        assertThat(answer.status()).isEqualTo("created");
        assertThat(answer.json().path("replays").toString()).isEqualTo("[\"b.%s\",\"a.%s\"]".formatted(group, group));
        assertThat(answer.json().path("topics").toString())
                .isEqualTo("[\"data.b.replay.%s\",\"data.a.replay.%s\"]".formatted(group, group));
        DesiredReplay last = DesiredReplay.read(farm.read(Topics.REPLAYS).get(3).value());
        assertThat(last.plan().from()).isEqualTo(30_000);
        assertThat(last.clock()).isEqualTo(new Clock(NOW + 60_000, 40_000));
    }

    @Test
    void resumesAtThePausedPosition() throws Exception {
        String group = start(",'speed':10");
        desired();
        farm.pass(Duration.ofSeconds(5)); // the clock ran for 3 s of it
        assertThat(steered(group, "'pause'", "paused").clock()).isEqualTo(new Clock(NOW + 5000, 40_000));
        farm.pass(Duration.ofSeconds(60));
        DesiredReplay resumed = steered(group, "'resume'", "running");
        assertThat(resumed.clock()).isEqualTo(new Clock(NOW + 66_000, 40_000));
        assertThat(request("'command':'resume','group':'" + group + "'").error())
                .contains("wrong-state");
    }

    @Test
    void seeksAllMembersTogether() throws Exception {
        String group = start("");
        desired();
        farm.pass(Duration.ofSeconds(5));
        DesiredReplay seeking = steered(group, "'seek','to':50000", "running");
        assertThat(seeking.seek()).isEqualTo(new DesiredReplay.Seek(50_000, seeking.sequence()));
        assertThat(seeking.clock()).isEqualTo(new Clock(NOW + 6000, 50_000));
        steered(group, "'pause'", "paused");
        DesiredReplay held = steered(group, "'seek','to':60000", "paused");
        assertThat(held.position(NOW + 1_000_000)).isEqualTo(60_000);
        for (String outside : List.of("9999", "90001")) {
            assertThat(request("'command':'seek','group':'" + group + "','to':" + outside)
                            .error())
                    .contains("wrong-member");
        }
    }

    @Test
    void changesTheSpeedAtTheCurrentPosition() throws Exception {
        String group = start("");
        desired();
        assertThat(steered(group, "'speed','speed':5", "running").clock())
                .as("before it begins")
                .isEqualTo(new Clock(NOW + 2000, 10_000));
        farm.pass(Duration.ofSeconds(5));
        DesiredReplay faster = steered(group, "'speed','speed':0.5", "running");
        assertThat(faster.clock()).isEqualTo(new Clock(NOW + 5000, 25_000));
        assertThat(faster.position(NOW + 7000)).isEqualTo(26_000);
        assertThat(request("'command':'speed','speed':'max','group':'" + group + "'")
                        .error())
                .contains("wrong-member");
    }

    @Test
    void loopsOverARange() throws Exception {
        String group = start("");
        desired();
        farm.pass(Duration.ofSeconds(7));
        DesiredReplay inside = steered(group, "'loop','from':12000,'to':20000", "running");
        assertThat(inside.range()).isEqualTo(new Range(12_000, 20_000));
        assertThat(inside.clock()).isEqualTo(new Clock(NOW + 7000, 15_000));
        assertThat(inside.seek()).isNull();

        farm.pass(Duration.ofSeconds(8)); // at 23 s, resumed 3 s ago
        DesiredReplay all = steered(group, "'loop'", "running");
        assertThat(all.clock()).isEqualTo(new Clock(NOW + 15_000, 15_000));
        assertThat(all.range()).isNull();

        DesiredReplay outside = steered(group, "'loop','from':30000,'to':40000", "running");
        assertThat(outside.clock()).isEqualTo(new Clock(NOW + 16_000, 30_000));
        assertThat(outside.seek()).isEqualTo(new DesiredReplay.Seek(30_000, outside.sequence()));
        assertThat(request("'command':'loop','from':91000,'to':95000,'group':'" + group + "'")
                        .error())
                .contains("wrong-member");
    }

    @Test
    void stopsAllMembersAndRemovesEachOnceItIsOver() throws Exception {
        String group = start("");
        desired();
        DesiredReplay stopped = steered(group, "'stop'", "deleted");
        assertThat(stopped.desired()).isEqualTo(ReplayStatus.State.STOPPED);
        for (String mission : List.of("a", "b")) {
            farm.pipe(
                    Topics.REPLAYS_STATUS,
                    mission + "." + group,
                    new ReplayStatus(stopped.sequence(), ReplayStatus.State.STOPPED, null, true, null).toBytes());
            TestRecord<String, byte[]> removed = farm.only(Topics.REPLAYS);
            assertThat(removed.key()).isEqualTo(mission + "." + group);
            assertThat(removed.value()).isNull();
        }
        CommandResult unknown = request("'command':'pause','group':'" + group + "'");
        assertThat(unknown.error()).contains("unknown-replay");
        assertThat(unknown.json().path("reason").asText()).contains(group);
    }

    private void ended(String mission, String group, long of) {
        farm.pipe(
                Topics.REPLAYS_STATUS,
                mission + "." + group,
                new ReplayStatus(of, ReplayStatus.State.ENDED, null, true, null).toBytes());
    }

    @Test
    void removesAnEndedGroupAsAWhole() throws Exception {
        String group = start("");
        DesiredReplay started = desired();
        farm.pass(Duration.ofMinutes(2));
        ended("a", group, started.sequence());
        assertThat(steered(group, "'pause'", "paused").desired()).as("b plays").isEqualTo(ReplayStatus.State.PAUSED);
        DesiredReplay resumed = steered(group, "'resume'", "running");
        ended("a", group, resumed.sequence());
        farm.pass(Duration.ofMinutes(30));
        ended("b", group, resumed.sequence());
        assertThat(request("'command':'pause','group':'" + group + "'").error()).contains("wrong-state");
        farm.pass(Duration.ofMinutes(59));
        assertThat(farm.read(Topics.REPLAYS)).as("together").isEmpty();

        DesiredReplay again = steered(group, "'seek','to':50000", "running");
        ended("a", group, again.sequence());
        ended("b", group, again.sequence());
        farm.pass(Duration.ofMinutes(61));

        assertThat(farm.read(Topics.REPLAYS))
                .hasSize(2)
                .allSatisfy(each -> assertThat(each.value()).isNull());
    }

    @Test
    void rejectsCommandsToSingleMembersAndSteps() throws Exception {
        String group = start("");
        desired();
        for (String command : List.of("pause", "stop", "step")) {
            CommandResult alone = request("'command':'" + command + "','replay':'a." + group + "'");
            assertThat(alone.error()).contains("wrong-state");
            assertThat(alone.json().path("reason").asText()).contains("'" + group + "'");
        }
        assertThat(request("'command':'step','group':'" + group + "'").error()).contains("wrong-state");
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            'missions':['a','c','d']                        | unknown-mission | 'c', 'd'
            'mission':'c'                                   | unknown-mission | /api/recordings
            'missions':['a','b'],'from':90001               | wrong-member    | 'from'
            'missions':['a','b'],'range':{'from':1,'to':2}  | wrong-member    | overlap
            'missions':['a','b'],'speed':'max'              | wrong-member    | max
            'mission':'a','startAt':'2026-03-31T08:00:01Z'  | wrong-member    | 30 days
            'mission':'a','topic':'data.x.replay.0000000a'  | replay-exists   | 'a.0000000a'
            'mission':'b','topic':'data.x.replay.0000000a'  | replay-exists   | 'data.x.replay.0000000a'
            """)
    void rejectsAnInvalidStart(String members, String error, String message) throws Exception {
        start("");
        assertThat(request("'command':'start','mission':'a','topic':'data.x.replay.0000000a'")
                        .error())
                .isEmpty();
        farm.read(Topics.REPLAYS);

        CommandResult rejected = request("'command':'start'," + members);

        assertThat(rejected.error()).contains(error);
        assertThat(rejected.json().path("reason").asText()).contains(message);
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();
    }

    @Test
    void acceptsOnlyListedMissions() throws Exception {
        start("");
        farm.pipe(Topics.RECORDINGS, "a", null);
        farm.pipe(Topics.RECORDINGS, "b", "no JSON".getBytes(UTF_8));
        assertThat(request("'command':'start','mission':'a'").error()).contains("unknown-mission");
        assertThat(request("'command':'start','mission':'b'").error()).contains("unknown-mission");
        assertThat(request("'command':'start','mission':'a','source':{'file':'a.jsonl'}")
                        .error())
                .as("a source is not looked up")
                .isEmpty();
    }

    @Test
    void requiresTimesIfRecordingsAreUnknown() throws Exception {
        try (ManagerFixture without = new ManagerFixture()) {
            Set<String> answers = new HashSet<>();
            for (String times : List.of("", ",'from':1", ",'from':1,'to':9")) {
                without.request(
                        Topics.REPLAY_MANAGER,
                        null,
                        "{'type':'request','command':'start','missions':['x','y']" + times + "}");
                CommandResult answer = ManagerFixture.response(without.only(Topics.REPLAY_MANAGER));
                answers.add(answer.error().orElse(answer.status()));
            }
            assertThat(answers).containsExactlyInAnyOrder("missing-member", "created");
            assertThat(without.read(Topics.REPLAYS)).hasSize(2);
        }
    }
}
