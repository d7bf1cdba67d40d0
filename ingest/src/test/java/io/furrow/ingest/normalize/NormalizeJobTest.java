package io.furrow.ingest.normalize;

import java.time.Duration;
import java.time.Instant;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.flink.JobUids;
import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.CollectedOutput;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class NormalizeJobTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    private static final long RECEIVED = 1_700_000_060_000L;
    private static final long TIME = 1_700_000_000_000L;
    private static final String NORMALIZED = "{'subscriptionId':'s1','data':[{'id':'t','type':'Thermometer',"
            + "'Temperature':{'type':'Number','value':21.5,'metadata':{}},"
            + "'Time':{'type':'Number','value':1700000000000,'metadata':{}}}]}";

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
                    normalized           | {'subscriptionId':'s1','data':[{'id':'t','type':'Thermometer','Temperature':{'type':'Number','value':21.5,'metadata':{}},'Time':{'type':'Number','value':1700000000000,'metadata':{}}}]}
                    keyValues            | {'subscriptionId':'s1','data':[{'id':'t','type':'Thermometer','Temperature':21.5,'Time':1700000000000}]}
                    simplifiedNormalized | {'id':'t','type':'Thermometer','Temperature':{'type':'Number','value':21.5,'metadata':{}},'Time':{'type':'Number','value':1700000000000,'metadata':{}}}
                    simplifiedKeyValues  | {'id':'t','type':'Thermometer','Temperature':21.5,'Time':1700000000000}
                    """)
    void makesTheSameRecordOfEveryFormAsTheSourceWould(String form, String body) throws Exception {
        var headers = Map.of("Fiware-Service", "farm", "Fiware-Servicepath", "/north", "Ngsiv2-AttrsFormat", form);

        List<TopicRecord> written = run(options(), notification(null, body, headers));

        Entity entity = Entity.parse(
                ("{'id':'t','type':'Thermometer','Temperature':{'type':'Number','value':21.5,'metadata':{}},"
                                + "'Time':{'type':'Number','value':1700000000000,'metadata':{}}}")
                        .replace('\'', '"')
                        .getBytes(UTF_8));
        Map<String, String> asTheSource = EntityEvent.of(
                        entity,
                        FiwareScope.of("farm", "/north"),
                        Instant.ofEpochMilli(RECEIVED),
                        EventTimeRule.within(Duration.ofMinutes(5)),
                        Origin.KAFKA)
                .headers(form.startsWith("simplified") ? "/ngsi/normalize" : "/ngsi/s1");
        assertThat(written).singleElement().satisfies(record -> {
            assertThat(record.topic()).isEqualTo("data.raw");
            assertThat(record.key()).isEqualTo("t".getBytes(UTF_8));
            assertThat(record.timestamp()).isEqualTo(TIME);
            assertThat(record.value()).isEqualTo(entity.toBytes());
            assertThat(record.headers()).isEqualTo(asTheSource).containsEntry("origin", "kafka");
        });
    }

    @Test
    void takesANotificationWithTheEntityIdAsItsKeyAndTheDefaultScope() throws Exception {
        assertThat(run(options(), notification("t", NORMALIZED, Map.of())))
                .singleElement()
                .satisfies(record -> assertThat(record.headers())
                        .containsAllEntriesOf(Map.of(HeaderNames.SERVICE, "", HeaderNames.SERVICE_PATH, "/")));
    }

    @Test
    void makesADeletionARecordWithoutAValue() throws Exception {
        String deleted = "{'subscriptionId':'s1','data':[{'id':'t','type':'Thermometer',"
                + "'alterationType':{'type':'Text','value':'entityDelete','metadata':{}}}]}";

        assertThat(run(options(), notification(null, deleted, Map.of())))
                .singleElement()
                .satisfies(record -> {
                    assertThat(record.value()).isNull();
                    assertThat(record.timestamp()).isEqualTo(RECEIVED);
                    assertThat(record.headers()).containsEntry(HeaderNames.CE_TYPE, HeaderNames.TYPE_DELETED);
                });
    }

    @Test
    void setsAsideWhatCannotBeReadAndKeepsTheRestOfTheNotification() throws Exception {
        String half = "{'subscriptionId':'s1','data':[{'type':'NoId'},{'id':'t','type':'Thermometer'}]}";

        List<TopicRecord> written = run(
                options(),
                notification("k", half, Map.of()),
                notification("k", "{not json", Map.of("trace", "7")),
                notification("k", null, Map.of()));

        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.raw"))
                .hasSize(1);
        assertThat(written)
                .filteredOn(record -> record.topic().equals("ngsi.notifications.dead"))
                .extracting(record -> record.headers().get(DeadLetter.REASON))
                .containsExactlyInAnyOrder("not-an-entity", "not-json", "not-an-event");
        assertThat(written)
                .filteredOn(record -> "not-json".equals(record.headers().get(DeadLetter.REASON)))
                .singleElement()
                .satisfies(dead -> {
                    assertThat(new String(dead.value(), UTF_8)).isEqualTo("{not json");
                    assertThat(dead.headers())
                            .containsEntry("trace", "7")
                            .containsEntry(DeadLetter.STAGE, "normalize")
                            .containsEntry(DeadLetter.SOURCE, "ngsi.notifications-0@3");
                });
    }

    @Test
    void dropsWhatFurrowItselfWroteIntoTheContextBroker() throws Exception {
        String echo = "{'subscriptionId':'s1','data':[{'id':'a','type':'Analytics:Collision'},{'id':'t','type':'T'}]}";

        assertThat(run(options(), notification(null, echo, Map.of()))).hasSize(1);
        assertThat(run(options("--exclude-types", "T"), notification(null, echo, Map.of())))
                .extracting(record -> new String(record.key(), UTF_8))
                .containsExactly("a");
    }

    @Test
    void setsAsideAnEntityThatMakesTooLargeARecord() throws Exception {
        assertThat(run(options("--max-record-bytes", "100"), notification(null, NORMALIZED, Map.of())))
                .extracting(record -> record.topic() + " " + record.headers().get(DeadLetter.REASON))
                .containsExactly("ngsi.notifications.dead too-large");
    }

    @ParameterizedTest
    @ValueSource(strings = {"--out-of-orderness=1s", "--idle-timeout=1s", "--idle-advance"})
    void takesNoOptionOfEventTimeWhichItHasNot(String option) {
        assertThatThrownBy(() -> options(option)).hasMessageContaining("Unknown option: '" + option + "'");
    }

    @Test
    void refusesAWrongSettingInOneSentence() {
        assertThatThrownBy(() -> options("--max-clock-skew", "1h").settings()).hasMessageContaining("--max-clock-skew");
        assertThatThrownBy(() -> options("--exclude-types", "(").settings()).hasMessageContaining("--exclude-types (");
    }

    @Test
    void keepsTheUidsThatSavepointsKnow() {
        assertThat(JobUids.of(NormalizeJob.assemble(options()))).isEqualTo(JobUids.checkedIn("normalize"));
        assertThat(options().input()).containsExactly("ngsi.notifications");
    }

    private static List<TopicRecord> run(NormalizeOptions options, TopicRecord... notifications) throws Exception {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        env.setParallelism(1);
        DataStream<TopicRecord> source = env.fromData(Arrays.asList(notifications))
                .uid("records")
                .assignTimestampsAndWatermarks(WatermarkStrategy.noWatermarks())
                .uid("timestamps");
        CollectedOutput out = new CollectedOutput();
        NormalizeJob.define(source, out, options);
        return out.run();
    }

    private static NormalizeOptions options(String... args) {
        NormalizeOptions options = new NormalizeOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }

    private static TopicRecord notification(String key, String body, Map<String, String> headers) {
        return new TopicRecord(
                "ngsi.notifications",
                0,
                3,
                RECEIVED,
                key == null ? null : key.getBytes(UTF_8),
                body == null ? null : body.replace('\'', '"').getBytes(UTF_8),
                new HashMap<>(headers));
    }
}
