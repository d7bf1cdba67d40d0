package io.furrow.ingest.route;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithKeyedOperator;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedTwoInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** All devices are in the default scope, so that {@code |/|robot} is the identity of {@code robot}. */
class AssignMissionTest {
    private static final AssignMission.Rule RULE = new AssignMission.Rule(Duration.ofMillis(1000), "home", "");

    private static final int BUDGET = 20;

    private final ArrayList<TopicRecord> onTheTopic = new ArrayList<>();
    private final ArrayList<TopicRecord> domains = new ArrayList<>();
    private final ArrayList<TopicRecord> missions = new ArrayList<>();
    private final HashSet<String> topics = new HashSet<>();

    @AutoClose
    private KeyedTwoInputStreamOperatorTestHarness<String, ReportedEvent, DeviceChange, ReportedEvent> operator;

    @BeforeEach
    void open() throws Exception {
        create();
        operator.open();
    }

    @Test
    void takesTheWordOfTheEventThenOfTheDevicesThenTheDefault() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));

        report("robot", 100, "north", "mowing");
        report("robot", 100, "", "");
        report("robot", 99, "", "");
        report("stranger", 100, "", "");
        report("robot", 100, "farm", "");
        report("robot", 100, "north", "");

        assertThat(routes())
                .containsExactly("north/mowing", "farm/weeding", "home/", "home/", "farm/weeding", "north/");
    }

    @Test
    void assignsAnEventThatComesLateAsOfItsOwnTime() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));
        broadcast(1, version("robot", "farm", "sowing", 200, 2));

        report("robot", 250, "", "");
        report("robot", 150, "", "");

        assertThat(routes()).containsExactly("farm/sowing", "farm/weeding");
    }

    @Test
    void knowsWhatIsOnTheTopicBeforeTheStreamOfDevicesHasBroughtAnything() throws Exception {
        operator.close();
        onTheTopic(0, version("robot", "farm", "weeding", 100, 1));
        onTheTopic(1, version("robot", "farm", "sowing", 200, 2));
        create();
        operator.open();

        report("robot", 250, "", "");
        broadcast(0, version("robot", "farm", "weeding", 100, 1)); // the stream is behind what was read at the start
        report("robot", 250, "", "");
        broadcast(1, version("robot", "farm", "sowing", 200, 2));
        broadcast(2, version("robot", "farm", "mowing", 240, 3));
        report("robot", 250, "", "");

        assertThat(routes()).containsExactly("farm/sowing", "farm/sowing", "farm/mowing");
    }

    @Test
    void sendsADeletionWhereTheNewestEventWentAndForgetsTheEntity() throws Exception {
        report("robot", 200, "farm", "sowing");
        report("robot", 100, "farm", "weeding");
        delete("robot", 300);
        assertThat(operator.numKeyedStateEntries()).isZero();
        delete("robot", 301);

        assertThat(routes()).containsExactly("farm/sowing", "farm/weeding", "farm/sowing", "home/");
    }

    @Test
    void remembersTheRouteOfAnEntityThatCameBackBeforeItsDeletionCame() throws Exception {
        report("robot", 200, "farm", "sowing");
        delete("robot", 150);
        delete("robot", 300);

        assertThat(routes()).containsExactly("farm/sowing", "farm/sowing", "farm/sowing");
        assertThat(operator.numKeyedStateEntries()).isZero();
    }

    @Test
    void forgetsTheEntityWithTheDeletionThatFollowsReportsOfAClockThatIsAhead() throws Exception {
        event("robot", 260, 200, "farm", "sowing", new byte[0]);
        delete("robot", 205);

        assertThat(routes()).containsExactly("farm/sowing", "farm/sowing");
        assertThat(operator.numKeyedStateEntries()).isZero();
    }

    @Test
    void forgetsDevicesThatEndedLongerAgoThanTheyAreKept() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));
        broadcast(1, new DeviceChange("|/|robot", 0, 1, 200, null));
        report("robot", 150, "", "");
        assertThat(operator.getOperator()
                        .getOperatorStateBackend()
                        .getBroadcastState(AssignMission.DEVICES)
                        .contains("|/|robot"))
                .isTrue();

        broadcast(2, new DeviceChange("|/|other", 0, 2, 1201, null));

        assertThat(operator.getOperator()
                        .getOperatorStateBackend()
                        .getBroadcastState(AssignMission.DEVICES)
                        .entries())
                .isEmpty();
        report("robot", 150, "", "");
        assertThat(routes()).containsExactly("farm/weeding", "home/");
    }

    @Test
    void remembersDevicesAndRoutesAcrossARestart() throws Exception {
        broadcast(0, version("robot", "farm", "weeding", 100, 1));
        report("robot", 200, "north", "mowing");
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        onTheTopic(1, new DeviceChange("|/|robot", 0, 1, 300, null));
        create();
        operator.initializeState(snapshot);
        operator.open();

        report("robot", 150, "", "");
        report("robot", 300, "", "");
        delete("robot", 400);

        assertThat(routes())
                .as("the end of the device came while the job was down")
                .containsExactly("farm/weeding", "home/", "home/");
    }

    @Test
    void takesSoManyOtherMissionsAndTheRestOfTheirEventsWithoutThem() throws Exception {
        for (int run = 0; run < 100; run++) {
            report("robot", 100 + run, "home", "run-" + run);
        }

        assertThat(routes()).hasSize(100);
        assertThat(routes().stream().filter("home/"::equals)).hasSize(100 - (BUDGET - 1)); // the domain is new, too
        assertThat(letters())
                .hasSize(100 - (BUDGET - 1))
                .first()
                .satisfies(letter -> assertThat(letter.headers())
                        .containsAllEntriesOf(Map.of("dead-reason", "unknown-mission", "dead-stage", "routes")));
    }

    @Test
    void countsTheTopicsThatThereAreAlsoAfterARestart() throws Exception {
        for (int run = 0; run < BUDGET; run++) {
            topics.add("data.home.realtime.run-" + run);
        }
        operator.setProcessingTime(1_000);

        report("robot", 100, "home", "run-3");
        report("robot", 101, "", "run-new");
        assertThat(letters())
                .hasSize(2)
                .first()
                .satisfies(letter -> assertThat(letter.headers())
                        .containsEntry(
                                "dead-message",
                                "domain home is not known, and 20 names that are not known have topics; delete topics that are of no more"
                                        + " use, or see --other-names"));

        topics.clear();
        operator.setProcessingTime(1_000_000); // on a slow machine a reading takes long, and the next one is due later
        report("robot", 300, "home", "run-later");
        assertThat(routes()).endsWith("home/run-later");
    }

    @Test
    void countsNamesThatGetNoTopicBesideThoseThatDo() throws Exception {
        operator.close();
        create(new AssignMission.Rule(Duration.ofMillis(1000), "", ""));
        operator.open();
        useUpTheBudget();

        report("robot", 500, "", "run-beyond");
        report("robot", 501, "own", "mowing");

        assertThat(routes()).endsWith("/run-19", "/", "own/mowing");
        assertThat(letters())
                .extracting(letter -> letter.headers().get("dead-message"))
                .containsExactly(
                        "mission run-beyond is not known, and 20 names that are not known and have no topic were taken"
                                + " since the start; see --other-names");
    }

    @Test
    void countsNoTopicThatTheControlPlaneIsAboutToDelete() throws Exception {
        domains.add(deleted("north"));
        for (int run = 0; run < BUDGET; run++) {
            missions.add(deleted("run-" + run));
            topics.add("data.north.realtime.run-" + run);
        }
        topics.add("data.north.realtime");
        operator.setProcessingTime(1_000);

        report("robot", 100, "north", "run-3");
        report("robot", 101, "own", "mowing");

        assertThat(routes()).containsExactly("north/run-3", "own/mowing");
    }

    @Test
    void takesWhatTheControlPlaneKnowsBeyondTheBudgetAlsoWhereItIsNew() throws Exception {
        useUpTheBudget();
        domains.add(managed("north", "{}"));
        missions.add(managed("weeding", "{'domain':'north'}"));
        operator.setProcessingTime(1_000);

        report("robot", 500, "north", "weeding");
        report("robot", 501, "", "weeding");
        report("robot", 502, "south", "weeding");

        assertThat(routes()).endsWith("north/weeding", "home/", "/");
    }

    @Test
    void takesWhatAnEntityReportedForBeforeARestartBeyondTheBudget() throws Exception {
        report("robot", 100, "own", "mowing");
        OperatorSubtaskState state = operator.snapshot(1, 1);
        operator.close();
        create();
        operator.initializeState(state);
        operator.open();
        useUpTheBudget();

        report("robot", 500, "own", "mowing");

        assertThat(routes()).endsWith("own/mowing");
    }

    @Test
    void letsNoEventIntoTheMissionOfAnotherDomain() throws Exception {
        operator.close();
        domains.add(managed("north", "{}"));
        domains.add(managed("south", "{}"));
        missions.add(managed("weeding", "{'domain':'north','created':400}"));
        create();
        operator.open();

        report("robot", 500, "south", "weeding");
        report("robot", 399, "south", "weeding"); // of an earlier mission of this name
        report("robot", 500, "west", "weeding"); // not of this control plane

        assertThat(routes()).containsExactly("south/", "south/weeding", "west/weeding");
        assertThat(letters())
                .extracting(letter -> letter.headers().get("dead-message"))
                .containsExactly("mission weeding belongs to domain north, the event to domain south");
    }

    private void useUpTheBudget() throws Exception {
        for (int i = 0; i < BUDGET; i++) {
            report("other", 100 + i, "", "run-" + i);
        }
    }

    private List<TopicRecord> letters() {
        List<TopicRecord> letters = new ArrayList<>();
        operator.getSideOutput(DeadLetters.TAG).forEach(record -> letters.add(record.getValue()));
        return letters;
    }

    private static TopicRecord managed(String name, String json) {
        return onService(name, json.replace('\'', '"').getBytes(UTF_8));
    }

    private static TopicRecord deleted(String name) {
        return onService(name, null);
    }

    private static TopicRecord onService(String name, byte[] value) {
        return new TopicRecord("service", 0, 0, 0, name.getBytes(UTF_8), value, Map.of());
    }

    private void create() throws Exception {
        create(RULE);
    }

    private void create(AssignMission.Rule rule) throws Exception {
        List<TopicRecord> records = List.copyOf(onTheTopic);
        operator = new KeyedTwoInputStreamOperatorTestHarness<>(
                new CoBroadcastWithKeyedOperator<>(
                        new AssignMission(
                                new OnTheTopic(records),
                                rule,
                                new NameBudget(
                                        new OnTheTopic(domains),
                                        new OnTheTopic(missions),
                                        () -> Set.copyOf(topics),
                                        true,
                                        BUDGET)),
                        List.of(AssignMission.DEVICES)),
                ReportedEvent::identity,
                null,
                Types.STRING);
    }

    /** Serializable in name only: the harness does not send it anywhere. */
    private record OnTheTopic(List<TopicRecord> records) implements TopicSnapshot {
        @Override
        public List<TopicRecord> read() {
            return records;
        }
    }

    private void onTheTopic(long offset, DeviceVersion version) {
        onTheTopic.add(new TopicRecord(Topics.DEVICES, 0, offset, 0, new byte[0], version.toBytes(), Map.of()));
    }

    private void onTheTopic(long offset, DeviceChange end) {
        byte[] key = end.key().getBytes(UTF_8);
        onTheTopic.add(new TopicRecord(Topics.DEVICES, 0, offset, end.time(), key, null, Map.of()));
    }

    private void broadcast(long offset, DeviceVersion version) throws Exception {
        broadcast(offset, new DeviceChange(version.key(), 0, offset, version.from(), version));
    }

    private void broadcast(long offset, DeviceChange change) throws Exception {
        operator.processElement2(new StreamRecord<>(change, offset));
    }

    private void report(String id, long time, String domain, String mission) throws Exception {
        event(id, time, time, domain, mission, new byte[0]);
    }

    private void delete(String id, long time) throws Exception {
        event(id, time, time, "", "", null);
    }

    private void event(String id, long time, long received, String domain, String mission, byte[] value)
            throws Exception {
        Map<String, String> headers = Map.of(HeaderNames.TS_SOURCE, Long.toString(received));
        TopicRecord record = TopicRecord.of(Topics.RAW, time, id, value, headers);
        operator.processElement1(
                new StreamRecord<>(new ReportedEvent("e", "|/|" + id, id, "Robot", domain, mission, record), time));
    }

    private List<String> routes() {
        return operator.extractOutputValues().stream()
                .map(event -> event.domain() + "/" + event.mission())
                .toList();
    }

    private static DeviceVersion version(String id, String domain, String mission, long from, long sequence) {
        return new DeviceVersion(id, "", "/", domain, mission, from, null, sequence, null);
    }
}
