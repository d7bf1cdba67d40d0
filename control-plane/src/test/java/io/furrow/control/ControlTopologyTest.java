package io.furrow.control;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.Set;

import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.apache.kafka.streams.StreamsConfig;
import org.apache.kafka.streams.TopologyTestDriver;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.control.mission.MissionOptions;
import io.furrow.model.control.Limits;
import io.furrow.model.control.Response;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class ControlTopologyTest {
    private static final Duration REMEMBERED = Duration.ofHours(1);
    private static final Instant START = Instant.parse("2026-03-01T08:00:00Z");

    private final TopologyTestDriver driver = new TopologyTestDriver(
            ControlTopology.of(REMEMBERED, new MissionOptions(Duration.ofSeconds(30), new FiwareScope("farm", "/"))),
            settings(),
            START);

    @AfterEach
    void close() {
        driver.close();
    }

    /** As the WeLASER dashboard asks. */
    @Test
    void answersARequestForANewDomainOnTheTopicOfTheRequest() throws Exception {
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','domain':'north'}");

        TestRecord<String, byte[]> answer = only(Topics.DOMAIN_MANAGER);
        assertThat(text(answer.value()))
                .isEqualTo(
                        "{\"type\":\"response\",\"status\":\"created\",\"domain\":\"north\",\"topic\":\"data.north.realtime\"}");
        assertThat(answer.key()).isNull();
        TestRecord<String, byte[]> domain = only(Topics.DOMAINS);
        assertThat(domain.key()).isEqualTo("north");
        assertThat(NgsiJson.read(domain.value()).path("created").asLong()).isEqualTo(START.toEpochMilli());
    }

    @Test
    void givesTheSameRequestOneEffectAndOneAnswer() {
        String request = "{'type':'request','requestId':'r-1','domain':'north'}";
        ask(Topics.DOMAIN_MANAGER, "mine", request);
        ask(Topics.DOMAIN_MANAGER, "mine", "{'domain':'north','type':'request','requestId':'r-1'}");

        assertThat(only(Topics.DOMAIN_MANAGER).key()).isEqualTo("r-1");
        assertThat(read(Topics.DOMAINS)).hasSize(1);
    }

    /** Else whoever asks for something new would take the answer of something old for its own. */
    @Test
    void refusesAnotherRequestUnderTheSameId() {
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','requestId':'r-1','user':'ann','domain':'north'}");
        assertThat(response(only(Topics.DOMAIN_MANAGER)).status()).isEqualTo("created");
        for (String other : List.of(
                "'user':'ann','domain':'south'",
                "'user':'bob','domain':'north'",
                "'user':'ann','command':'nonsense','domain':'north'")) {
            ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','requestId':'r-1'," + other + "}");
            assertThat(error(only(Topics.DOMAIN_MANAGER))).isEqualTo("request-id-reused");
        }
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','requestId':'r-1','user':'ann','domain':'north'}");
        assertThat(read(Topics.DOMAIN_MANAGER)).isEmpty();
        assertThat(read(Topics.DOMAINS)).hasSize(1);
    }

    @Test
    void refusesARequestThatIsTooLarge() {
        String domain = "{'type':'request','requestId':'r-1','domain':'north','description':'%s'}"
                .formatted("x".repeat(Limits.REQUEST_BYTES));
        ask(Topics.DOMAIN_MANAGER, null, domain);
        ask(Topics.DOMAIN_MANAGER, null, domain);

        TestRecord<String, byte[]> answer = only(Topics.DOMAIN_MANAGER);
        assertThat(error(answer)).isEqualTo("too-large");
        assertThat(response(answer).json().path("domain").asText()).isEqualTo("north");
        assertThat(response(answer).json().path("reason").asText())
                .contains(Integer.toString(domain.length()), "524288");
        assertThat(read(Topics.DOMAINS)).isEmpty();
        assertThat(read(Topics.AUDIT)).hasSize(1);
    }

    @Test
    void answersARefusedRequestOnceToo() {
        String request = "{'type':'request','requestId':'r-1','command':'nonsense','mission':'m'}";
        ask(Topics.MISSION_MANAGER, "mine", request);
        ask(Topics.MISSION_MANAGER, "mine", request);
        ask(Topics.MISSION_MANAGER, "mine", "{'type':'request',");

        List<TestRecord<String, byte[]>> answers = read(Topics.MISSION_MANAGER);
        assertThat(answers).extracting(answer -> error(answer)).containsExactly("unknown-command", "not-json");
        assertThat(answers).extracting(TestRecord::key).containsExactly("r-1", "mine");
    }

    @Test
    void forgetsIdsOfRequestsAfterTheTimeForThat() {
        String request = "{'type':'request','requestId':'r-1','domain':'north'}";
        ask(Topics.DOMAIN_MANAGER, null, request);
        driver.advanceWallClockTime(REMEMBERED.minusSeconds(1));
        ask(Topics.DOMAIN_MANAGER, null, request);
        assertThat(read(Topics.DOMAIN_MANAGER)).hasSize(1);
        driver.advanceWallClockTime(REMEMBERED.dividedBy(4));
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','requestId':'r-2','domain':'south'}");
        read(Topics.DOMAIN_MANAGER);
        ask(Topics.DOMAIN_MANAGER, null, request);
        assertThat(error(only(Topics.DOMAIN_MANAGER))).isEqualTo("domain-exists");
        int remembered = 0;
        try (var all = driver.<String, byte[]>getWindowStore("domain-answers").all()) {
            while (all.hasNext()) {
                all.next();
                remembered++;
            }
        }
        assertThat(remembered).isEqualTo(2);
    }

    @Test
    void passesOverAnswersAndRecordsWithoutAValue() {
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','domain':'north'}");
        TestRecord<String, byte[]> answer = only(Topics.DOMAIN_MANAGER);
        pipe(Topics.DOMAIN_MANAGER, answer.key(), answer.value());
        pipe(Topics.DOMAIN_MANAGER, null, null);
        assertThat(read(Topics.DOMAIN_MANAGER)).isEmpty();
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','domain':'south'}");
        assertThat(read(Topics.DOMAIN_MANAGER)).hasSize(1);
    }

    @Test
    void takesAMissionThroughItsLifeAsHostsReport() throws Exception {
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','domain':'north'}");
        ask(
                Topics.MISSION_MANAGER,
                null,
                "{'type':'request','command':'start','mission':'m','domain':'north','devices':[{'type':'Camera','count':2}]}");
        assertThat(state("m")).isEqualTo("starting");
        assertThat(hostAll(DeviceStatus.State.RUNNING)).isEqualTo(2);
        assertThat(state("m")).isEqualTo("running");

        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','command':'delete','domain':'north'}");
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','command':'delete','domain':'north','force':true}");
        assertThat(read(Topics.DOMAIN_MANAGER))
                .extracting(record ->
                        response(record).error().orElse(response(record).status()))
                .containsExactly("created", "missions-running", "deleted");
        assertThat(state("m")).isEqualTo("stopping");
        assertThat(hostAll(DeviceStatus.State.STOPPED)).isEqualTo(2);
        assertThat(state("m")).isEqualTo("stopped");
    }

    @Test
    void startsAMissionAtItsDateAndHasTheMissionOfTheThesisAtHand() throws Exception {
        ask(Topics.DOMAIN_MANAGER, null, "{'type':'request','domain':'north'}");
        ask(
                Topics.MISSION_MANAGER,
                null,
                "{'type':'request','command':'start','mission':'m','domain':'north','template':'thesis-demo','start':'2026-03-01T08:01:00Z'}");
        assertThat(state("m")).isEqualTo("created");
        assertThat(only(Topics.TEMPLATES).key()).isEqualTo("thesis-demo@1");
        driver.advanceWallClockTime(Duration.ofSeconds(59));
        assertThat(read(Topics.DEVICES)).isEmpty();
        driver.advanceWallClockTime(Duration.ofSeconds(1));
        assertThat(hostAll(DeviceStatus.State.RUNNING)).isEqualTo(5);
        assertThat(state("m")).isEqualTo("running");
    }

    @Test
    void setsAsideWhatIsNoStatus() {
        pipe(Topics.DEVICES_STATUS, "farm|/|x", "{\"sequence\":1}".getBytes(StandardCharsets.UTF_8));
        pipe(Topics.DEVICES_STATUS, "farm|/|x", null);

        TestRecord<String, byte[]> dead = only(Topics.dead(Topics.DEVICES_STATUS));
        assertThat(text(dead.value())).isEqualTo("{\"sequence\":1}");
        assertThat(text(dead.headers().lastHeader(DeadLetter.REASON).value())).isEqualTo("not-an-event");
    }

    @Test
    void handsReplaysOnAndForgetsThemWhenTheyAreOver() throws Exception {
        ask(
                Topics.REPLAY_MANAGER,
                null,
                "{'type':'request','command':'start','mission':'m','speed':'max','from':1000,'devices':['urn:x']}");
        Response created = response(only(Topics.REPLAY_MANAGER));
        String replay = created.json().path("replay").asText();
        assertThat(replay).matches("m\\.[0-9a-f]{8}");
        assertThat(created.json().path("topic").asText()).isEqualTo("data.m.replay." + replay.substring(2));

        for (String command : List.of("step", "pause", "step", "step", "seek", "resume", "resume", "stop", "stop")) {
            ask(
                    Topics.REPLAY_MANAGER,
                    null,
                    "{'type':'request','command':'" + command + "','to':5000,'replay':'" + replay + "'}");
        }
        assertThat(read(Topics.REPLAY_MANAGER))
                .extracting(record ->
                        response(record).error().orElse(response(record).status()))
                .containsExactly(
                        "wrong-state",
                        "paused",
                        "paused",
                        "paused",
                        "paused",
                        "running",
                        "wrong-state",
                        "deleted",
                        "wrong-state");
        List<TestRecord<String, byte[]>> wanted = read(Topics.REPLAYS);
        assertThat(text(wanted.get(wanted.size() - 1).value()))
                .contains("\"from\":1000,\"speed\":\"max\"", "\"wanted\":\"stopped\"")
                .contains("\"seek\":{\"to\":5000,\"sequence\":5},\"step\":{\"total\":2,\"sequence\":4}")
                .endsWith("\"sequence\":7}");

        pipe(Topics.REPLAYS_STATUS, replay, "{\"sequence\":6,\"state\":\"ended\"}".getBytes(StandardCharsets.UTF_8));
        assertThat(read(Topics.REPLAYS)).isEmpty();
        pipe(Topics.REPLAYS_STATUS, replay, "{\"sequence\":7,\"state\":\"stopped\"}".getBytes(StandardCharsets.UTF_8));
        assertThat(only(Topics.REPLAYS).value()).isNull();
        ask(Topics.REPLAY_MANAGER, null, "{'type':'request','command':'stop','replay':'" + replay + "'}");
        assertThat(error(only(Topics.REPLAY_MANAGER))).isEqualTo("unknown-replay");
    }

    /** State and offsets are found by these names. */
    @Test
    void hasANameForEveryStoreAndEveryTopicOfItsOwn() {
        assertThat(ControlTopology.of(REMEMBERED, new MissionOptions(REMEMBERED, FiwareScope.DEFAULT))
                        .describe()
                        .toString())
                .doesNotContain("-0000")
                .contains("domain-requests-repartition", "mission-requests-repartition", "replay-requests-repartition");
        assertThat(driver.getAllStateStores().keySet())
                .isEqualTo(Set.of(
                        "domains",
                        "farm-sequence",
                        "domain-answers",
                        "domain-positions",
                        "missions",
                        "mission-statuses",
                        "devices",
                        "mission-device-lists",
                        "mission-rollouts",
                        "templates",
                        "template-versions",
                        "mission-answers",
                        "mission-positions",
                        "device-statuses-positions",
                        "replays",
                        "replay-sequence",
                        "replay-answers",
                        "replay-positions",
                        "replay-statuses-positions"));
    }

    private void ask(String topic, String key, String json) {
        pipe(topic, key, json.replace('\'', '"').getBytes(StandardCharsets.UTF_8));
    }

    private void pipe(String topic, String key, byte[] value) {
        driver.createInputTopic(topic, new StringSerializer(), new ByteArraySerializer())
                .pipeInput(key, value);
    }

    private List<TestRecord<String, byte[]>> read(String topic) {
        return driver.createOutputTopic(topic, new StringDeserializer(), new ByteArrayDeserializer())
                .readRecordsToList();
    }

    private TestRecord<String, byte[]> only(String topic) {
        List<TestRecord<String, byte[]>> all = read(topic);
        assertThat(all).hasSize(1);
        return all.get(0);
    }

    /** The newest that {@code service.missions.status} says. */
    private String state(String mission) throws Exception {
        String state = null;
        for (TestRecord<String, byte[]> record : read(Topics.MISSIONS_STATUS)) {
            assertThat(record.key()).isEqualTo(mission);
            state = NgsiJson.read(record.value()).path("state").asText();
        }
        return state;
    }

    /** Reports a state of each device that was asked for since. */
    private int hostAll(DeviceStatus.State state) throws Exception {
        List<TestRecord<String, byte[]>> asked = new ArrayList<>(read(Topics.DEVICES));
        for (TestRecord<String, byte[]> record : asked) {
            long sequence = DeviceVersion.read(record.value()).sequence();
            pipe(Topics.DEVICES_STATUS, record.key(), new DeviceStatus(sequence, state, null).toBytes());
        }
        return asked.size();
    }

    private static String error(TestRecord<String, byte[]> record) {
        return response(record).error().orElseThrow();
    }

    private static Response response(TestRecord<String, byte[]> record) {
        try {
            return Response.read(record.value());
        } catch (io.furrow.model.ngsi.UnreadableException e) {
            throw new AssertionError(e);
        }
    }

    private static String text(byte[] bytes) {
        return new String(bytes, StandardCharsets.UTF_8);
    }

    private static Properties settings() {
        Properties settings = new Properties();
        settings.setProperty(StreamsConfig.APPLICATION_ID_CONFIG, "furrow-control-plane");
        settings.setProperty(StreamsConfig.BOOTSTRAP_SERVERS_CONFIG, "unused:0");
        settings.setProperty(StreamsConfig.PROCESSING_GUARANTEE_CONFIG, StreamsConfig.EXACTLY_ONCE_V2);
        return settings;
    }
}
