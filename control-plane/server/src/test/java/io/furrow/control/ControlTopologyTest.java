package io.furrow.control;

import java.time.Duration;
import java.util.List;
import java.util.Set;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static io.furrow.control.ManagerFixture.REMEMBERED;
import static io.furrow.control.ManagerFixture.error;
import static io.furrow.control.ManagerFixture.response;
import static io.furrow.control.ManagerFixture.text;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ControlTopologyTest {
    @AutoClose
    private final ManagerFixture farm = new ManagerFixture();

    /** As the WeLASER dashboard asks. */
    @Test
    void answersARequestForANewDomainOnTheTopicOfTheRequest() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");

        TestRecord<String, byte[]> answer = farm.only(Topics.DOMAIN_MANAGER);
        assertThat(text(answer.value()))
                .isEqualTo(
                        "{\"type\":\"response\",\"status\":\"created\",\"domain\":\"north\",\"topic\":\"data.north.realtime\"}");
        assertThat(answer.key()).isNull();
        TestRecord<String, byte[]> domain = farm.only(Topics.DOMAINS);
        assertThat(domain.key()).isEqualTo("north");
        assertThat(NgsiJson.read(domain.value()).path("created").asLong())
                .isEqualTo(ManagerFixture.START.toEpochMilli());
    }

    @Test
    void givesTheSameRequestOneEffectAndOneAnswer() {
        String request = "{'type':'request','requestId':'r-1','domain':'north'}";
        farm.request(Topics.DOMAIN_MANAGER, "mine", request);
        farm.request(Topics.DOMAIN_MANAGER, "mine", "{'domain':'north','type':'request','requestId':'r-1'}");

        assertThat(farm.only(Topics.DOMAIN_MANAGER).key()).isEqualTo("r-1");
        assertThat(farm.read(Topics.DOMAINS)).hasSize(1);
    }

    /** Else whoever asks for something new would take the answer of something old for its own. */
    @Test
    void rejectsAnotherRequestUnderTheSameId() {
        farm.request(Topics.DOMAIN_MANAGER, "'requestId':'r-1','user':'ann','domain':'north'");
        assertThat(response(farm.only(Topics.DOMAIN_MANAGER)).status()).isEqualTo("created");
        for (String other : List.of(
                "'user':'ann','domain':'south'",
                "'user':'bob','domain':'north'",
                "'user':'ann','command':'nonsense','domain':'north'")) {
            farm.request(Topics.DOMAIN_MANAGER, "'requestId':'r-1'," + other);
            assertThat(error(farm.only(Topics.DOMAIN_MANAGER))).isEqualTo("request-id-reused");
        }
        farm.request(Topics.DOMAIN_MANAGER, "'requestId':'r-1','user':'ann','domain':'north'");
        assertThat(farm.read(Topics.DOMAIN_MANAGER)).isEmpty();
        assertThat(farm.read(Topics.DOMAINS)).hasSize(1);
    }

    @Test
    void endsTheFieldsOfADomainThatIsDeletedAndReportsSo() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        FieldVersion field = new FieldVersion(
                "f", 0, (ObjectNode) NgsiJson.read("{\"type\":\"Polygon\"}".getBytes(UTF_8)), (ObjectNode)
                        NgsiJson.read("{\"Domain\":\"north\"}".getBytes(UTF_8)));
        farm.pipe(Topics.FIELDS, field.key(), field.toBytes());
        farm.pipe(Topics.FIELDS, "g", new byte[] {'?'});
        farm.request(Topics.DOMAIN_MANAGER, "'command':'delete','domain':'north'");

        TestRecord<String, byte[]> end = farm.only(Topics.FIELDS);
        assertThat(end.key()).isEqualTo("f@2026-03-01T08:00:00.000Z");
        assertThat(FieldVersion.read(end.value()).isEnd()).isTrue();
        JsonNode audit = NgsiJson.read(farm.read(Topics.AUDIT).get(1).value());
        assertThat(audit.path("about").toString())
                .isEqualTo("{\"domain\":\"north\",\"missionCount\":0,\"fieldCount\":1,\"fields\":\"f\"}");
    }

    @Test
    void rejectsARequestThatIsTooLarge() {
        String domain = "{'type':'request','requestId':'r-1','domain':'north','description':'%s'}"
                .formatted("x".repeat(Limits.REQUEST_BYTES));
        farm.request(Topics.DOMAIN_MANAGER, null, domain);
        farm.request(Topics.DOMAIN_MANAGER, null, domain);

        TestRecord<String, byte[]> answer = farm.only(Topics.DOMAIN_MANAGER);
        assertThat(error(answer)).isEqualTo("too-large");
        assertThat(response(answer).json().path("domain").asText()).isEqualTo("north");
        assertThat(response(answer).json().path("reason").asText())
                .contains(Integer.toString(domain.length()), "524288");
        assertThat(farm.read(Topics.DOMAINS)).isEmpty();
        assertThat(farm.read(Topics.AUDIT)).hasSize(1);
    }

    @Test
    void answersARefusedRequestOnceToo() {
        String request = "{'type':'request','requestId':'r-1','command':'nonsense','mission':'m'}";
        farm.request(Topics.MISSION_MANAGER, "mine", request);
        farm.request(Topics.MISSION_MANAGER, "mine", request);
        farm.request(Topics.MISSION_MANAGER, "mine", "{'type':'request',");

        List<TestRecord<String, byte[]>> answers = farm.read(Topics.MISSION_MANAGER);
        assertThat(answers).extracting(answer -> error(answer)).containsExactly("unknown-command", "not-json");
        assertThat(answers).extracting(TestRecord::key).containsExactly("r-1", "mine");
    }

    @Test
    void forgetsIdsOfRequestsAfterTheTimeForThat() {
        String request = "{'type':'request','requestId':'r-1','domain':'north'}";
        farm.request(Topics.DOMAIN_MANAGER, null, request);
        farm.pass(REMEMBERED.minusSeconds(1));
        farm.request(Topics.DOMAIN_MANAGER, null, request);
        assertThat(farm.read(Topics.DOMAIN_MANAGER)).hasSize(1);
        farm.pass(REMEMBERED.dividedBy(4));
        farm.request(Topics.DOMAIN_MANAGER, "'requestId':'r-2','domain':'south'");
        farm.read(Topics.DOMAIN_MANAGER);
        farm.request(Topics.DOMAIN_MANAGER, null, request);
        assertThat(error(farm.only(Topics.DOMAIN_MANAGER))).isEqualTo("domain-exists");
        assertThat(farm.remembered("domain-responses")).isEqualTo(2);
    }

    @Test
    void passesOverAnswersAndRecordsWithoutAValue() {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        TestRecord<String, byte[]> answer = farm.only(Topics.DOMAIN_MANAGER);
        farm.pipe(Topics.DOMAIN_MANAGER, answer.key(), answer.value());
        farm.pipe(Topics.DOMAIN_MANAGER, null, null);
        assertThat(farm.read(Topics.DOMAIN_MANAGER)).isEmpty();
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'south'");
        assertThat(farm.read(Topics.DOMAIN_MANAGER)).hasSize(1);
    }

    @Test
    void takesAMissionThroughItsLifeAsHostsReport() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        farm.request(
                Topics.MISSION_MANAGER,
                "'command':'start','mission':'m','domain':'north','devices':[{'type':'Camera','count':2,'simulated':true}]");
        assertThat(farm.state("m")).isEqualTo("starting");
        assertThat(farm.hostAll(DeviceStatus.State.RUNNING)).isEqualTo(2);
        assertThat(farm.state("m")).isEqualTo("running");

        farm.request(Topics.MISSION_MANAGER, "'command':'stop','mission':'m'");
        farm.request(Topics.DOMAIN_MANAGER, "'command':'delete','domain':'north'");
        assertThat(farm.read(Topics.DOMAIN_MANAGER))
                .extracting(record ->
                        response(record).error().orElse(response(record).status()))
                .containsExactly("created", "missions-running");
        assertThat(farm.state("m")).isEqualTo("stopping");
        assertThat(farm.hostAll(DeviceStatus.State.STOPPED)).isEqualTo(2);
        assertThat(farm.state("m")).isEqualTo("stopped");

        farm.request(Topics.DOMAIN_MANAGER, "'command':'delete','domain':'north'");
        assertThat(farm.only(Topics.MISSIONS_STATUS).value()).isNull();
        assertThat(farm.read(Topics.DEVICES)).extracting(TestRecord::value).containsOnlyNulls();
    }

    @Test
    void countsARealDeviceByTheReportThatTheFarmWatchSaw() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        farm.request(
                Topics.MISSION_MANAGER,
                "'command':'start','mission':'m','domain':'north','devices':[{'type':'Camera'}]");
        farm.hostAll(DeviceStatus.State.RUNNING);
        farm.pass(Duration.ofHours(1));
        assertThat(farm.state("m")).isEqualTo("starting");

        String heard = "{\"id\":\"urn:ngsi-ld:Camera:m-1\",\"heard\":%d}"
                .formatted(ManagerFixture.START.plus(Duration.ofMinutes(1)).toEpochMilli());
        farm.pipe(Topics.DEVICES_HEALTH, "farm|/|urn:ngsi-ld:Camera:m-1", heard.getBytes(UTF_8));
        assertThat(farm.state("m")).isEqualTo("running");
        farm.pipe(Topics.DEVICES_HEALTH, "x", "[]".getBytes(UTF_8));
        assertThat(farm.read(Topics.dead(Topics.DEVICES_HEALTH))).hasSize(1);
    }

    @Test
    void startsAMissionAtItsDateAndHasTheMissionOfTheThesisAtHand() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        farm.request(
                Topics.MISSION_MANAGER,
                "'command':'start','mission':'m','domain':'north','template':'thesis-demo','start':'2026-03-01T08:01:00Z'");
        assertThat(farm.state("m")).isEqualTo("created");
        assertThat(farm.only(Topics.TEMPLATES).key()).isEqualTo("thesis-demo@1");
        farm.pass(Duration.ofSeconds(59));
        assertThat(farm.read(Topics.DEVICES)).isEmpty();
        farm.pass(Duration.ofSeconds(1));
        assertThat(farm.hostAll(DeviceStatus.State.RUNNING)).isEqualTo(5);
        assertThat(farm.state("m")).isEqualTo("running");
    }

    @Test
    void setsAsideWhatIsNoStatus() {
        farm.pipe(Topics.DEVICES_STATUS, "farm|/|x", "{\"sequence\":1}".getBytes(UTF_8));
        farm.pipe(Topics.DEVICES_STATUS, "farm|/|x", null);

        TestRecord<String, byte[]> dead = farm.only(Topics.dead(Topics.DEVICES_STATUS));
        assertThat(text(dead.value())).isEqualTo("{\"sequence\":1}");
        assertThat(text(dead.headers().lastHeader(DeadLetter.REASON).value())).isEqualTo("not-an-event");
    }

    @Test
    void handsReplaysOnAndForgetsThemWhenTheyAreOver() throws Exception {
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

    /** Its recording lasts from 1 s to 9 s. */
    private void report(String replay, long sequence, ReplayStatus.State state, boolean settled) {
        String status = """
                {"sequence":%d,"state":"%s","settled":%s,"progress":{"position":9000,"from":1000,"to":9000}}""".formatted(sequence, state.code(), settled);
        farm.pipe(Topics.REPLAYS_STATUS, replay, status.getBytes(UTF_8));
    }

    @Test
    void startsNoReplayBeyondThoseThatMayPlayAtOneTime() {
        List<String> replays = IntStream.range(0, ReplaySettings.DEFAULT.max() - 1)
                .mapToObj(number -> startReplay(""))
                .toList();
        String group = "{'type':'request','command':'start','missions':['a','b'],'from':1000,'to':9000}";
        farm.request(Topics.REPLAY_MANAGER, null, group);
        CommandResult refused = response(farm.only(Topics.REPLAY_MANAGER));
        assertThat(refused.error()).contains("quota-exceeded");
        assertThat(refused.json().path("reason").asText())
                .isEqualTo(
                        "255 replays are not over, of at most 256 (--max-replays); stop one that is not needed any more");

        report(replays.get(0), 1, ReplayStatus.State.ENDED, false);
        farm.request(Topics.REPLAY_MANAGER, null, group);

        assertThat(response(farm.only(Topics.REPLAY_MANAGER)).status()).isEqualTo("created");
    }

    @Test
    void letsAReplayRestAtItsEndForAnHour() {
        String replay = startReplay("");
        report(replay, 1, ReplayStatus.State.ENDED, false);
        report(replay, 1, ReplayStatus.State.ENDED, true);
        farm.pass(Duration.ofMinutes(50));
        report(replay, 1, ReplayStatus.State.ENDED, true); // by a job that was restarted
        farm.pass(Duration.ofMinutes(9));
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();

        assertThat(steer(replay, "'seek','to':5000").status()).isEqualTo("running");
        assertThat(text(farm.only(Topics.REPLAYS).value())).contains("\"seek\":{\"to\":5000,\"sequence\":2}");
        farm.pass(Duration.ofMinutes(61));
        assertThat(farm.read(Topics.REPLAYS)).as("sought, and not played yet").isEmpty();
        report(replay, 2, ReplayStatus.State.RUNNING, false);
        report(replay, 2, ReplayStatus.State.ENDED, true);
        farm.pass(Duration.ofMinutes(59));
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();
        farm.pass(Duration.ofMinutes(1));

        assertThat(farm.only(Topics.REPLAYS).value()).isNull();
        assertThat(steer(replay, "'seek','to':5000").error()).contains("unknown-replay");
        farm.pass(Duration.ofHours(2));
        assertThat(farm.read(Topics.REPLAYS)).as("forgotten once").isEmpty();
    }

    @Test
    void stepsBackFromTheEndAndPlaysARangeOfWhatHasEnded() {
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
    void answersFromWhatAReplayIsNotFromWhatWasRequestedOfIt() {
        String replay = startReplay("");
        report(replay, 1, ReplayStatus.State.ENDED, false);
        for (String command : List.of("'pause'", "'resume'", "'step'", "'step','count':2")) {
            CommandResult refused = steer(replay, command);
            assertThat(refused.error()).as(command).contains("wrong-state");
            assertThat(refused.json().path("reason").asText()).contains("is ended", "'seek'");
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
    void forgetsAReplayThatFailedAtOnce() {
        String replay = startReplay("");
        report(replay, 1, ReplayStatus.State.FAILED, true);
        assertThat(farm.only(Topics.REPLAYS).value()).isNull();
    }

    @Test
    void rejectsASeekToWhatIsNotPlayed() {
        String whole = startReplay("");
        assertThat(steer(whole, "'seek','to':99000").error())
                .as("of what nobody knows")
                .isEmpty();
        farm.pipe(Topics.RECORDINGS, "m", new RecordedMission("m", 1000, 5000).toBytes());
        assertThat(steer(whole, "'seek','to':9000").error())
                .as("of a mission that runs, later than when it was listed")
                .isEmpty();
        report(whole, 3, ReplayStatus.State.RUNNING, false);
        String part = startReplay(",'from':2000,'to':8000");
        report(part, 4, ReplayStatus.State.RUNNING, false);
        farm.read(Topics.REPLAYS);

        for (String outside : List.of("999", "9001")) {
            CommandResult refused = steer(whole, "'seek','to':" + outside);
            assertThat(refused.error()).as(outside).contains("wrong-member");
            assertThat(refused.json().path("reason").asText())
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

    /** State and offsets are found by these names. */
    @Test
    void hasANameForEveryStoreAndEveryTopicOfItsOwn() {
        assertThat(ControlTopology.of(
                                REMEMBERED,
                                new MissionSettings(REMEMBERED, FiwareScope.DEFAULT, false),
                                ReplaySettings.DEFAULT)
                        .describe()
                        .toString())
                .doesNotContain("-0000")
                .contains("domain-requests-repartition", "mission-requests-repartition", "replay-requests-repartition");
        assertThat(farm.stores()).isEqualTo(Set.of("""
                                domains farm-sequence domain-responses domain-positions missions mission-statuses
                                devices mission-device-lists mission-rollouts templates template-versions
                                mission-responses mission-positions device-statuses-positions device-healths-positions
                                device-connections-positions replays replay-reports recordings fields replay-sequence
                                replay-responses replay-positions replay-statuses-positions""".split("\\s+")));
    }
}
