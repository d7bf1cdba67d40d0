package io.furrow.ingest;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import picocli.CommandLine.ParameterException;

import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static io.furrow.ingest.ReportedRecords.TIME;
import static io.furrow.ingest.ReportedRecords.at;
import static io.furrow.ingest.ReportedRecords.deletion;
import static io.furrow.ingest.ReportedRecords.options;
import static io.furrow.ingest.ReportedRecords.record;
import static io.furrow.ingest.ReportedRecords.run;
import static io.furrow.ingest.ReportedRecords.thermometer;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class IngestJobTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    @Test
    void bringsAnEventToItsDomainAndItsMissionUnchanged() throws Exception {
        TopicRecord reported = record("a", thermometer("t1", "farm", "weeding"));

        List<TopicRecord> written = run(options(), reported);

        assertThat(written)
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder("data.farm.realtime", "data.farm.realtime.weeding");
        assertThat(written).allSatisfy(record -> {
            assertThat(record.value()).isEqualTo(reported.value());
            assertThat(record.key()).isEqualTo(reported.key());
            assertThat(record.timestamp()).isEqualTo(TIME);
            assertThat(record.headers())
                    .containsAllEntriesOf(reported.headers())
                    .containsKey(HeaderNames.TS_INGEST);
        });
    }

    @Test
    void passesARepeatedEventOnce() throws Exception {
        TopicRecord first = record("a", thermometer("t1", "farm", ""));
        TopicRecord other = record("b", thermometer("t1", "farm", ""));

        assertThat(run(options(), first, first, other, first))
                .extracting(record -> record.headers().get(HeaderNames.CE_ID))
                .containsExactly("a", "b");
    }

    @Test
    void keepsTheOrderOfAnEntity() throws Exception {
        TopicRecord[] reported = new TopicRecord[200];
        for (int i = 0; i < reported.length; i++) {
            reported[i] = record("e" + i, thermometer("t" + i % 3, "farm", "").integer("n", i));
        }

        List<TopicRecord> written = run(options(), reported);

        assertThat(written).hasSize(reported.length);
        Map<String, Long> last = new HashMap<>();
        for (TopicRecord record : written) {
            Entity entity = Entity.parse(record.value());
            long n = entity.number("n").orElseThrow().longValue();
            assertThat(n).isGreaterThan(last.getOrDefault(entity.id(), -1L));
            last.put(entity.id(), n);
        }
    }

    @Test
    void usesTheDefaultsWhereAnEntityNamesNoDomainOrMission() throws Exception {
        TopicRecord robot = record("a", Entity.builder("robot", "ROBOT"));

        assertThat(run(options(), robot, record("b", thermometer("t", "farm", ""))))
                .extracting(TopicRecord::topic)
                .containsExactly("data.farm.realtime");
        assertThat(run(options("--default-domain", "home", "--default-mission", "m"), robot))
                .extracting(TopicRecord::topic)
                .containsExactly("data.home.realtime", "data.home.realtime.m");
    }

    @Test
    void makesATopicOfSoManyMissionsOnlyAndLosesNoEvent() throws Exception {
        TopicRecord[] reported = new TopicRecord[500];
        for (int i = 0; i < reported.length; i++) {
            reported[i] = record("e" + i, thermometer("t", "farm", "run-" + i));
        }

        List<String> topics = run(options("--other-names", "50"), reported).stream()
                .map(TopicRecord::topic)
                .toList();

        assertThat(topics.stream().distinct()).hasSize(1 + 49 + 1);
        assertThat(topics.stream().filter("data.farm.realtime"::equals)).hasSize(500);
        assertThat(topics.stream().filter("data.raw.dead"::equals)).hasSize(451);
    }

    @Test
    void takesNoReplay() {
        assertThatThrownBy(
                        () -> options("--input", "data.hoeing.replay.0a1b2c3d").inputTopics())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("is a replay, which ingest does not take");
    }

    @Test
    void routesADeviceByItsNewMissionFromThatEventOn() throws Exception {
        FixedDevices devices = FixedDevices.of(
                new DeviceVersion("robot", "", "/", "farm", "weeding", 0, null, 1, null),
                new DeviceVersion("robot", "", "/", "farm", "sowing", TIME + 1, null, 2, null));
        TopicRecord before = record("a", Entity.builder("robot", "ROBOT"));
        TopicRecord after = at(TIME + 1, record("b", Entity.builder("robot", "ROBOT")));

        assertThat(IngestRun.of(options("--no-latest"), devices, before, after))
                .extracting(record -> record.headers().get(HeaderNames.CE_ID) + " " + record.topic())
                .containsExactly(
                        "a data.farm.realtime",
                        "a data.farm.realtime.weeding",
                        "b data.farm.realtime",
                        "b data.farm.realtime.sowing");
    }

    @Test
    void letsAnEntitysOwnWordGoBeforeWhatIsKnownOfIt() throws Exception {
        FixedDevices devices = FixedDevices.of(new DeviceVersion("t", "", "/", "north", "weeding", 0, null, 1, null));

        assertThat(IngestRun.of(options("--no-latest"), devices, record("a", thermometer("t", "farm", "mowing"))))
                .extracting(TopicRecord::topic)
                .containsExactly("data.farm.realtime", "data.farm.realtime.mowing");
        assertThat(IngestRun.of(options("--no-latest"), devices, record("a", thermometer("t", "farm", ""))))
                .as("the mission that is known is not one of this domain")
                .extracting(TopicRecord::topic)
                .containsExactly("data.farm.realtime");
    }

    @Test
    void tellsOfADeletionWhereTheEntityWasToldOf() throws Exception {
        TopicRecord reported = record("a", thermometer("t", "farm", "weeding"));
        TopicRecord deleted = deletion("b", "t", TIME + 1);

        List<TopicRecord> written = IngestRun.of(options(), FixedDevices.of(), reported, deleted, deleted);

        assertThat(written)
                .filteredOn(record -> record.value() == null)
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder("data.farm.realtime", "data.farm.realtime.weeding", "data.latest");
        assertThat(written)
                .filteredOn(record -> record.value() == null)
                .allSatisfy(record -> assertThat(record.headers())
                        .containsEntry(HeaderNames.CE_TYPE, HeaderNames.TYPE_DELETED)
                        .containsKey(HeaderNames.TS_INGEST));
    }

    /** As NGSI-v2 allows: both exist, and each ends by itself. */
    @Test
    void keepsTwoEntitiesOfOneIdApartByTheirType() throws Exception {
        TopicRecord valve = record("v", Entity.builder("e-13", "Valve").text("Domain", "farm"));
        TopicRecord pump = record("p", Entity.builder("e-13", "Pump").text("Domain", "yard"));
        TopicRecord deleted = deletion("d", "e-13", TIME + 1).with(HeaderNames.ENTITY_TYPE, "Pump");
        TopicRecord late =
                at(TIME - 1, record("w", Entity.builder("e-13", "Valve").number("level", 1)));

        List<TopicRecord> written = IngestRun.of(options(), FixedDevices.of(), valve, pump, deleted, late);

        assertThat(written)
                .filteredOn(record -> record.topic().equals(Topics.LATEST))
                .extracting(record -> new String(record.key(), UTF_8)
                        + (record.value() == null
                                ? ""
                                : " is " + Entity.parse(record.value()).type()))
                .containsExactly("e-13 is Valve", "e-13 Pump is Pump", "e-13 Pump", "e-13 is Valve");
        assertThat(written)
                .filteredOn(record -> record.value() == null)
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder("data.yard.realtime", "data.latest");
    }

    @Test
    void endsAllEntitiesOfAnIdByADeletionThatNamesNoType() throws Exception {
        TopicRecord valve = record("v", Entity.builder("e-13", "Valve").text("Domain", "farm"));
        TopicRecord pump = record("p", Entity.builder("e-13", "Pump").text("Domain", "yard"));

        assertThat(IngestRun.of(options(), FixedDevices.of(), valve, pump, deletion("d", "e-13", TIME + 1)))
                .filteredOn(record -> record.value() == null)
                .extracting(record -> record.topic() + " " + new String(record.key(), UTF_8))
                .containsExactlyInAnyOrder(
                        "data.farm.realtime e-13",
                        "data.yard.realtime e-13",
                        "data.latest e-13",
                        "data.latest e-13 Pump");
    }

    @Test
    void keepsTheNewestOfEveryAttributeOnDataLatest() throws Exception {
        TopicRecord place = record("a", Entity.builder("t", "Thermometer").number("Latitude", 40));
        TopicRecord warm =
                at(TIME + 2, record("b", Entity.builder("t", "Thermometer").number("Temperature", 20)));
        TopicRecord coldBefore = at(
                TIME + 1,
                record(
                        "c",
                        Entity.builder("t", "Thermometer")
                                .number("Temperature", 2)
                                .bool("Status", true)));

        List<TopicRecord> written = IngestRun.of(options(), FixedDevices.of(), place, warm, coldBefore);

        assertThat(written)
                .extracting(TopicRecord::topic)
                .containsOnly("data.latest")
                .hasSize(3);
        TopicRecord newest = written.get(2);
        Entity entity = Entity.parse(newest.value());
        assertThat(newest.timestamp()).isEqualTo(TIME + 2);
        assertThat(newest.key()).isEqualTo("t".getBytes(UTF_8));
        assertThat(entity.type()).isEqualTo("Thermometer");
        assertThat(entity.number("Temperature")).contains(20.0);
        assertThat(entity.number("Latitude")).contains(40.0);
        assertThat(entity.value("Status")).isPresent();
    }

    @Test
    void leavesOutTheBranchesThatAreSwitchedOff() throws Exception {
        TopicRecord reported = record("a", thermometer("t", "farm", "weeding"));

        assertThat(IngestRun.of(options("--no-latest", "--no-routes"), FixedDevices.of(), reported))
                .isEmpty();
        assertThat(IngestRun.of(options("--no-routes"), FixedDevices.of(), reported))
                .extracting(TopicRecord::topic)
                .containsExactly("data.latest");
    }

    @Test
    void neverMergesADomainWithADotIntoAnother() throws Exception {
        assertThat(run(
                        options(),
                        record("a", thermometer("t", "north.7", "a.b")),
                        record("b", thermometer("t", "north", ""))))
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder(
                        "data._x-north-2E7.realtime", "data._x-north-2E7.realtime._x-a-2Eb", "data.north.realtime");
    }
}
