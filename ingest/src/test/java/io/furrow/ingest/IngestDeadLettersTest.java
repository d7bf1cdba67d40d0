package io.furrow.ingest;

import java.time.Duration;
import java.util.List;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;

import static io.furrow.ingest.ReportedRecords.at;
import static io.furrow.ingest.ReportedRecords.options;
import static io.furrow.ingest.ReportedRecords.record;
import static io.furrow.ingest.ReportedRecords.run;
import static io.furrow.ingest.ReportedRecords.thermometer;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class IngestDeadLettersTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

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
    void setsAsideWhatIsFromTheFutureAndGoesOnWithItsEntity() throws Exception {
        long tooFar = System.currentTimeMillis() + Duration.ofHours(2).toMillis();
        TopicRecord future = at(tooFar, record("x", thermometer("t1", "farm", "")));
        TopicRecord now = record("a", thermometer("t1", "farm", ""));

        List<TopicRecord> written = IngestRun.of(options(), FixedDevices.of(), future, now);

        assertThat(written)
                .extracting(record -> record.topic() + " " + record.headers().get(DeadLetter.REASON))
                .containsExactlyInAnyOrder(
                        "data.raw.dead from-the-future", "data.farm.realtime null", "data.latest null");
        assertThat(IngestRun.of(options("--max-ahead", "3h", "--no-latest"), FixedDevices.of(), future, now))
                .extracting(TopicRecord::topic)
                .containsOnly("data.farm.realtime");
    }

    @Test
    void setsAsideWhatOnlyALaterStageWouldFailAt() throws Exception {
        TopicRecord withoutValue = record("x", "k", "{\"id\":\"k\",\"type\":\"T\",\"n\":{\"type\":\"Number\"}}");
        TopicRecord endless =
                record("y", "k", "{\"id\":\"k\",\"type\":\"T\",\"n\":{\"type\":\"Number\",\"value\":1e1001}}");
        TopicRecord good = record("a", thermometer("t1", "farm", ""));

        assertThat(run(options(), withoutValue, endless, good))
                .extracting(record -> record.topic() + " " + record.headers().get(DeadLetter.REASON))
                .containsExactlyInAnyOrder(
                        "data.raw.dead not-an-entity", "data.raw.dead too-deep", "data.farm.realtime null");
    }

    @Test
    void setsAsideAnUnknownMissionOncePerEvent() throws Exception {
        TopicRecord unknown = record("x", thermometer("t1", "farm", "typo"));
        TopicRecord other = record("y", thermometer("t1", "farm", "typo"));

        TopicRecord ofOther = record("x", thermometer("t2", "farm", "typo"));

        assertThat(run(options("--other-names", "0"), unknown, unknown, other, ofOther))
                .filteredOn(record -> record.topic().equals("data.raw.dead"))
                .extracting(record -> record.headers().get(HeaderNames.CE_ID) + " " + new String(record.key(), UTF_8)
                        + " " + record.headers().get(DeadLetter.REASON))
                .containsExactlyInAnyOrder("x t1 unknown-mission", "y t1 unknown-mission", "x t2 unknown-mission");
    }
}
