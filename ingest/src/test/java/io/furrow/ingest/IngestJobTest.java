package io.furrow.ingest;

import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import picocli.CommandLine;

import io.furrow.flink.JobCommandLine;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

import static org.assertj.core.api.Assertions.assertThat;

class IngestJobTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setNumberTaskManagers(1)
            .setNumberSlotsPerTaskManager(2)
            .build());

    private static final int MORE_THAN_ANY_TEST_WRITES = 10_000;
    private static final long TIME = 1_700_000_000_000L;

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
    void setsAsideWhatIsNoEntityAndRoutesTheRest() throws Exception {
        TopicRecord garbage = record("x", "k", "{not json");
        TopicRecord otherSchema = record("y", "k", "{\"schema\":{\"type\":\"int32\"},\"payload\":7}");
        TopicRecord good = record("a", thermometer("t1", "farm", ""));

        List<TopicRecord> written = run(options(), garbage, otherSchema, good);

        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.raw.dead"))
                .extracting(record -> record.headers().get(DeadLetter.REASON))
                .containsExactlyInAnyOrder("not-json", "not-an-entity");
        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.raw.dead"))
                .filteredOn(record -> "not-json".equals(record.headers().get(DeadLetter.REASON)))
                .singleElement()
                .satisfies(dead -> {
                    assertThat(dead.value()).isEqualTo(garbage.value());
                    assertThat(dead.headers())
                            .containsEntry(DeadLetter.SOURCE, "data.raw-0@7")
                            .containsEntry(DeadLetter.STAGE, "ingest");
                });
        assertThat(written).extracting(TopicRecord::topic).contains("data.farm.realtime");
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
    void neverMergesADomainWithADotIntoAnother() throws Exception {
        assertThat(run(
                        options(),
                        record("a", thermometer("t", "north.7", "a.b")),
                        record("b", thermometer("t", "north", ""))))
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder(
                        "data._x-north-2E7.realtime", "data._x-north-2E7.realtime._x-a-2Eb", "data.north.realtime");
    }

    private static List<TopicRecord> run(IngestOptions options, TopicRecord... records) throws Exception {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        env.setParallelism(2);
        DataStream<TopicRecord> source = env.fromData(Arrays.asList(records))
                .setParallelism(1)
                .uid("records")
                .assignTimestampsAndWatermarks(WatermarkStrategy.<TopicRecord>forMonotonousTimestamps()
                        .withTimestampAssigner((record, ignored) -> record.timestamp()))
                .uid("timestamps")
                .keyBy(record -> new String(record.key(), StandardCharsets.UTF_8)); // as a topic's partitions do

        return IngestJob.define(source, options).executeAndCollect(MORE_THAN_ANY_TEST_WRITES);
    }

    private static IngestOptions options(String... args) {
        IngestOptions options = new IngestOptions();
        CommandLine line = JobCommandLine.of(options);
        line.parseArgs(args);
        return options;
    }

    private static EntityBuilder thermometer(String id, String domain, String mission) {
        return Entity.builder(id, "Thermometer").text("Domain", domain).text("Mission", mission);
    }

    private static TopicRecord record(String eventId, EntityBuilder entity) {
        Entity built = entity.build();
        return record(eventId, built.id(), new String(built.toBytes(), StandardCharsets.UTF_8));
    }

    private static TopicRecord record(String eventId, String key, String value) {
        return new TopicRecord(
                "data.raw",
                0,
                7,
                TIME,
                key.getBytes(StandardCharsets.UTF_8),
                value.getBytes(StandardCharsets.UTF_8),
                new HashMap<>(Map.of(HeaderNames.CE_ID, eventId)));
    }
}
