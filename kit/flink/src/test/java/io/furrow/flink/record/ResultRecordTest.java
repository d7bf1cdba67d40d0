package io.furrow.flink.record;

import org.junit.jupiter.api.Test;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ResultRecordTest {
    private static final FiwareScope SCOPE = new FiwareScope("farm", "/north");

    @Test
    void carriesTheEntityAndEveryHeaderThatReadersExpect() throws Exception {
        TopicRecord record = result(18.5, 60_000);

        assertThat(record.topic()).isEqualTo("data.answers");
        assertThat(record.key()).isEqualTo("key-1".getBytes(UTF_8));
        assertThat(record.timestamp()).isEqualTo(60_000);
        assertThat(Entity.parse(record.value()).number("answer")).contains(18.5);
        assertThat(record.headers())
                .containsEntry(HeaderNames.CE_SOURCE, "/analytics/answers")
                .containsEntry(HeaderNames.CE_TIME, "1970-01-01T00:01:00Z")
                .containsEntry(HeaderNames.CE_SPECVERSION, "1.0")
                .containsEntry(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED)
                .containsEntry(HeaderNames.SERVICE, "farm")
                .containsEntry(HeaderNames.SERVICE_PATH, "/north")
                .containsEntry(HeaderNames.TS_DEVICE, "60000");
    }

    @Test
    void givesTheSameResultTheSameIdAndAnotherResultAnother() {
        String id = result(18.5, 60_000).headers().get(HeaderNames.CE_ID);

        assertThat(result(18.5, 60_000).headers()).containsEntry(HeaderNames.CE_ID, id);
        assertThat(result(18.6, 60_000).headers().get(HeaderNames.CE_ID)).isNotEqualTo(id);
        assertThat(result(18.5, 60_001).headers().get(HeaderNames.CE_ID)).isNotEqualTo(id);
    }

    @Test
    void tellsTheOriginalTimeAndTheEpochOfAReplay() {
        EntityBuilder entity = Entity.builder("a", "Answer").number("answer", 1);
        String topic = "data.hoeing.replay.0a1b2c3d.answers";
        TopicRecord first = ResultRecord.of(topic, "a", entity, SCOPE, 60_000, "/s");
        TopicRecord second = ResultRecord.of(topic, "a", entity, SCOPE, 2 * Epochs.SPAN + 60_000, "/s");

        assertThat(first.headers()).containsEntry(HeaderNames.REPLAY_EPOCH, "0");
        assertThat(second.headers())
                .containsEntry(HeaderNames.REPLAY_EPOCH, "2")
                .containsEntry(HeaderNames.TS_DEVICE, "60000")
                .containsEntry(HeaderNames.CE_TIME, "1970-01-01T00:01:00Z");
        assertThat(second.timestamp()).isEqualTo(60_000);
        assertThat(second.headers().get(HeaderNames.CE_ID))
                .isNotEqualTo(first.headers().get(HeaderNames.CE_ID));
        assertThat(result(1, 1).headers()).doesNotContainKey(HeaderNames.REPLAY_EPOCH);
    }

    private static TopicRecord result(double answer, long timestamp) {
        EntityBuilder entity =
                Entity.builder("Analytics:Answer:1", "Analytics:Answer").number("answer", answer);
        return ResultRecord.of("data.answers", "key-1", entity, SCOPE, timestamp, "/analytics/answers");
    }
}
