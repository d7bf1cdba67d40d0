package io.furrow.control;

import java.time.Duration;
import java.util.List;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.model.control.Limits;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static io.furrow.control.ManagerFixture.REQUEST_RETENTION;
import static io.furrow.control.ManagerFixture.error;
import static io.furrow.control.ManagerFixture.response;
import static io.furrow.control.ManagerFixture.text;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ControlTopologyTest {
    @AutoClose
    private final ManagerFixture farm = new ManagerFixture();

    /** The request of the WeLASER dashboard. */
    @Test
    void createsADomainAndAnswersOnTheSameTopic() throws Exception {
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
    void executesARepeatedRequestOnce() {
        String request = "{'type':'request','requestId':'r-1','domain':'north'}";
        farm.request(Topics.DOMAIN_MANAGER, "mine", request);
        farm.request(Topics.DOMAIN_MANAGER, "mine", "{'domain':'north','type':'request','requestId':'r-1'}");

        assertThat(farm.only(Topics.DOMAIN_MANAGER).key()).isEqualTo("r-1");
        assertThat(farm.read(Topics.DOMAINS)).hasSize(1);
    }

    /** Else a client would accept the answer to an old request as its own. */
    @Test
    void rejectsAReusedRequestId() {
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
    void endsTheFieldsOfADeletedDomain() throws Exception {
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
    void mergesAPatchIntoADomain() throws Exception {
        String area =
                "{'type':'Polygon','coordinates':[[[0,0],[1,0],[1,1],[0,0]]],'bbox':[0,0,1,1],'note':'wet','by':'ann'}";
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north','name':'N','description':'d','area':" + area);
        farm.request(
                Topics.DOMAIN_MANAGER,
                "'command':'patch','domain':'north','name':null,'fields':['f'],'area':{'note':null,'by':'bob'}");

        JsonNode patched = NgsiJson.read(farm.read(Topics.DOMAINS).get(1).value());
        assertThat(patched.has("name")).isFalse();
        assertThat(patched.path("description").asText()).isEqualTo("d");
        assertThat(patched.path("fields")).hasSize(1);
        assertThat(patched.path("area").toString())
                .isEqualTo(
                        "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1,0],[1,1],[0,0]]],\"bbox\":[0,0,1,1],\"by\":\"bob\"}");
        farm.request(
                Topics.DOMAIN_MANAGER,
                "'command':'patch','domain':'north','area':{'coordinates':[[[0,0],[2,0],[2,2],[0,0]]]}");
        assertThat(NgsiJson.read(farm.only(Topics.DOMAINS).value()).path("area").toString())
                .as("without the bbox of the old coordinates")
                .isEqualTo("{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[2,0],[2,2],[0,0]]],\"by\":\"bob\"}");
        farm.read(Topics.DOMAIN_MANAGER);
        farm.request(Topics.DOMAIN_MANAGER, "'command':'patch','domain':'north','area':{'type':null}");
        assertThat(error(farm.only(Topics.DOMAIN_MANAGER))).isEqualTo("wrong-member");
        farm.request(Topics.DOMAIN_MANAGER, "'command':'patch','domain':'north','area':null");
        assertThat(NgsiJson.read(farm.only(Topics.DOMAINS).value()).has("area")).isFalse();
    }

    @Test
    void refusesARequestForAnotherSequence() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        long sequence = NgsiJson.read(farm.only(Topics.DOMAINS).value())
                .path("sequence")
                .asLong();
        farm.read(Topics.DOMAIN_MANAGER);

        String change = "'command':'change','domain':'%s','name':'a','ifSequence':%d";
        farm.request(Topics.DOMAIN_MANAGER, change.formatted("north", sequence + 1));
        assertThat(error(farm.only(Topics.DOMAIN_MANAGER))).isEqualTo("outdated");
        farm.request(Topics.DOMAIN_MANAGER, change.formatted("south", sequence));
        assertThat(error(farm.only(Topics.DOMAIN_MANAGER))).isEqualTo("outdated");
        farm.request(Topics.DOMAIN_MANAGER, change.formatted("north", sequence));
        assertThat(response(farm.only(Topics.DOMAIN_MANAGER)).status()).isEqualTo("changed");

        farm.request(Topics.MISSION_MANAGER, "'command':'create','mission':'m','domain':'north'");
        long ofMission = NgsiJson.read(farm.only(Topics.MISSIONS).value())
                .path("sequence")
                .asLong();
        farm.read(Topics.MISSION_MANAGER);
        farm.request(Topics.MISSION_MANAGER, "'command':'start','mission':'m','ifSequence':" + (ofMission - 1));
        assertThat(error(farm.only(Topics.MISSION_MANAGER))).isEqualTo("outdated");
        farm.read(Topics.MISSIONS_STATUS);
        String add = "'command':'add-devices','mission':'m','devices':[{'type':'Thermometer','count':3}],'ifSequence':";
        farm.request(Topics.MISSION_MANAGER, add + ofMission);
        assertThat(response(farm.only(Topics.MISSION_MANAGER)).status()).isEqualTo("changed");
        assertThat(NgsiJson.read(farm.only(Topics.MISSIONS_STATUS).value())
                        .path("sequence")
                        .asLong())
                .as("sequence of the mission and its status")
                .isEqualTo(NgsiJson.read(farm.only(Topics.MISSIONS).value())
                        .path("sequence")
                        .asLong())
                .isGreaterThan(ofMission);
        farm.request(Topics.MISSION_MANAGER, "'command':'start','mission':'m','ifSequence':" + ofMission);
        assertThat(error(farm.only(Topics.MISSION_MANAGER))).isEqualTo("outdated");
    }

    @Test
    void answersADryRunAndChangesNothing() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north','dryRun':true");

        assertThat(text(farm.only(Topics.DOMAIN_MANAGER).value()))
                .isEqualTo(
                        "{\"type\":\"response\",\"status\":\"created\",\"domain\":\"north\",\"topic\":\"data.north.realtime\",\"dryRun\":true}");
        assertThat(farm.read(Topics.DOMAINS)).isEmpty();
        assertThat(NgsiJson.read(farm.only(Topics.AUDIT).value()).path("result").asText())
                .isEqualTo("dry-run");
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north','dryRun':false");
        assertThat(response(farm.only(Topics.DOMAIN_MANAGER)).status()).isEqualTo("created");
        assertThat(NgsiJson.read(farm.only(Topics.DOMAINS).value())
                        .path("sequence")
                        .asInt())
                .isEqualTo(1);
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north','dryRun':true");
        TestRecord<String, byte[]> rejected = farm.only(Topics.DOMAIN_MANAGER);
        assertThat(error(rejected)).isEqualTo("domain-exists");
        assertThat(response(rejected).isDryRun()).isTrue();
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'south','dryRun':'yes'");
        assertThat(error(farm.only(Topics.DOMAIN_MANAGER))).isEqualTo("wrong-member");
    }

    @Test
    void startsNoMissionAndDeletesNothingInADryRun() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        String mission =
                "'command':'start','mission':'m','domain':'north','devices':[{'type':'Thermometer','count':3}]";
        farm.request(Topics.MISSION_MANAGER, mission + ",'dryRun':true");
        farm.pass(Duration.ofSeconds(2));
        assertThat(response(farm.only(Topics.MISSION_MANAGER)).status()).isEqualTo("created");
        assertThat(farm.read(Topics.MISSIONS)).isEmpty();
        assertThat(farm.read(Topics.DEVICES)).isEmpty();

        farm.request(Topics.MISSION_MANAGER, mission);
        farm.request(Topics.DOMAIN_MANAGER, "'command':'delete','domain':'north','force':true,'dryRun':true");
        assertThat(response(farm.read(Topics.DOMAIN_MANAGER).get(1)).json().path("stopped"))
                .hasSize(1);
        assertThat(farm.state("m")).isEqualTo("starting");
        assertThat(farm.only(Topics.DOMAINS).value()).isNotNull();
        farm.request(Topics.REPLAY_MANAGER, "'command':'start','mission':'m','dryRun':true");
        assertThat(response(farm.only(Topics.REPLAY_MANAGER)).isDryRun()).isTrue();
        assertThat(farm.read(Topics.REPLAYS)).isEmpty();
    }

    @Test
    void rejectsAnOversizedRequest() {
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
    void answersARejectedRequestOnce() {
        String request = "{'type':'request','requestId':'r-1','command':'nonsense','mission':'m'}";
        farm.request(Topics.MISSION_MANAGER, "mine", request);
        farm.request(Topics.MISSION_MANAGER, "mine", request);
        farm.request(Topics.MISSION_MANAGER, "mine", "{'type':'request',");

        List<TestRecord<String, byte[]>> answers = farm.read(Topics.MISSION_MANAGER);
        assertThat(answers).extracting(answer -> error(answer)).containsExactly("unknown-command", "not-json");
        assertThat(answers).extracting(TestRecord::key).containsExactly("r-1", "mine");
    }

    @Test
    void dropsRequestIdsAfterTheRetention() {
        String request = "{'type':'request','requestId':'r-1','domain':'north'}";
        farm.request(Topics.DOMAIN_MANAGER, null, request);
        farm.pass(REQUEST_RETENTION.minusSeconds(1));
        farm.request(Topics.DOMAIN_MANAGER, null, request);
        assertThat(farm.read(Topics.DOMAIN_MANAGER)).hasSize(1);
        farm.pass(REQUEST_RETENTION.dividedBy(4));
        farm.request(Topics.DOMAIN_MANAGER, "'requestId':'r-2','domain':'south'");
        farm.read(Topics.DOMAIN_MANAGER);
        farm.request(Topics.DOMAIN_MANAGER, null, request);
        assertThat(error(farm.only(Topics.DOMAIN_MANAGER))).isEqualTo("domain-exists");
        assertThat(farm.countRequestIds("domain-responses")).isEqualTo(2);
    }

    @Test
    void skipsAnswersAndTombstones() {
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        TestRecord<String, byte[]> answer = farm.only(Topics.DOMAIN_MANAGER);
        farm.pipe(Topics.DOMAIN_MANAGER, answer.key(), answer.value());
        farm.pipe(Topics.DOMAIN_MANAGER, null, null);
        assertThat(farm.read(Topics.DOMAIN_MANAGER)).isEmpty();
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'south'");
        assertThat(farm.read(Topics.DOMAIN_MANAGER)).hasSize(1);
    }

    @Test
    void runsAMissionAsHostsReport() throws Exception {
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
    void countsARealDeviceOnceTheFarmWatchReportsIt() throws Exception {
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
    void startsAMissionFromTheBuiltInTemplateAtItsDate() throws Exception {
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
    void writesADeadLetterForAnInvalidStatus() {
        farm.pipe(Topics.DEVICES_STATUS, "farm|/|x", "{\"sequence\":1}".getBytes(UTF_8));
        farm.pipe(Topics.DEVICES_STATUS, "farm|/|x", null);

        TestRecord<String, byte[]> dead = farm.only(Topics.dead(Topics.DEVICES_STATUS));
        assertThat(text(dead.value())).isEqualTo("{\"sequence\":1}");
        assertThat(text(dead.headers().lastHeader(DeadLetter.REASON).value())).isEqualTo("not-an-event");
    }

    /** State and offsets are found by these names. */
    @Test
    void namesEveryStoreAndInternalTopic() {
        assertThat(ControlTopology.of(
                                REQUEST_RETENTION,
                                new MissionSettings(REQUEST_RETENTION, FiwareScope.DEFAULT, false),
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
