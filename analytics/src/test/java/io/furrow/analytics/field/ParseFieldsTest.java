package io.furrow.analytics.field;

import java.util.List;
import java.util.Map;

import org.apache.flink.streaming.api.operators.ProcessOperator;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.OneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ParseFieldsTest {
    private static final String SQUARE =
            "{\"type\":\"Polygon\",\"coordinates\":[[[10,50],[20,50],[20,60],[10,60],[10,50]]]}";
    private static final String CROSSED = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}";
    private static final String SPRING = "2026-03-01T00:00:00.000Z";

    private final FieldRecords topic = new FieldRecords();

    @AutoClose
    private OneInputStreamOperatorTestHarness<TopicRecord, TopicRecord> operator;

    @BeforeEach
    void create() throws Exception {
        operator = new OneInputStreamOperatorTestHarness<>(new ProcessOperator<>(new ParseFields("presence")));
    }

    @Test
    void passesVersionsEndsAndWhatIsTakenAwayOn() throws Exception {
        topic.square("f", 100, "canary");
        topic.end("f", 200);
        topic.takeAway("f", 200);
        topic.add("f@2026-03-01T00:00:00Z", feature("f", SQUARE));

        recognize();

        assertThat(operator.extractOutputValues())
                .extracting(TopicRecord::position)
                .containsExactly(
                        "service.fields-0@0", "service.fields-0@1", "service.fields-0@2", "service.fields-0@3");
        assertThat(operator.getSideOutput(DeadLetters.TAG)).isNullOrEmpty();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            f@SPRING | SQUARE  | g | not-an-event | the key names f@2026-03-01T00:00:00.000Z, the value is g@2026-03-01T00:00:00.000Z
            f        | SQUARE  | f | not-an-event | the key 'f' is not a <field id>@<time>
            f@SPRING | CROSSED | f | not-an-event | field f@2026-03-01T00:00:00.000Z is not a valid area: Self-intersection
            f@SPRING | [       | f | not-json     |
            """)
    void setsWhatIsNoFieldAside(String key, String geometry, String id, String reason, String why) throws Exception {
        String area = geometry.replace("SQUARE", SQUARE).replace("CROSSED", CROSSED);
        TopicRecord bad = topic.add(key.replace("SPRING", SPRING), feature(id, area));

        recognize();

        assertThat(operator.extractOutputValues()).isEmpty();
        List<TopicRecord> dead = operator.getSideOutput(DeadLetters.TAG).stream()
                .map(StreamRecord::getValue)
                .toList();
        assertThat(dead).hasSize(1);
        assertThat(dead.get(0).topic()).isEqualTo("service.fields.dead");
        assertThat(dead.get(0).value()).isEqualTo(bad.value());
        assertThat(dead.get(0).headers())
                .containsAllEntriesOf(Map.of(DeadLetter.REASON, reason, DeadLetter.STAGE, "presence"))
                .hasEntrySatisfying(
                        DeadLetter.MESSAGE, message -> assertThat(message).contains(why == null ? "" : why));
    }

    @Test
    void setsARecordWithoutAKeyAside() throws Exception {
        topic.add(null, feature("f", SQUARE));

        recognize();

        assertThat(operator.getSideOutput(DeadLetters.TAG)).hasSize(1);
    }

    private void recognize() throws Exception {
        operator.open();
        for (TopicRecord record : topic.all()) {
            operator.processElement(record, 0);
        }
    }

    private static byte[] feature(String id, String geometry) {
        return ("{\"type\":\"Feature\",\"id\":\"" + id + "\",\"geometry\":" + geometry
                        + ",\"properties\":{\"validFrom\":\"" + SPRING + "\"}}")
                .getBytes(UTF_8);
    }
}
