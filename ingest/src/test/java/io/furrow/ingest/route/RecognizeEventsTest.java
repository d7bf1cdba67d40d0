package io.furrow.ingest.route;

import java.nio.charset.StandardCharsets;
import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class RecognizeEventsTest {
    private static final String ROBOT = "{\"id\":\"r\",\"type\":\"Robot\",\"n\":{\"value\":%d}}";

    @Test
    void keepsTheIdThatAnEventBears() throws Exception {
        ReportedEvent event = RecognizeEvents.recognize(record(ROBOT.formatted(1), Map.of(HeaderNames.CE_ID, "a")));

        assertThat(event.id()).isEqualTo("a");
        assertThat(event.identity()).isEqualTo("|/|r");
    }

    @ParameterizedTest
    @ValueSource(strings = {"", " "})
    void givesAnIdWhereOneIsEmpty(String empty) throws Exception {
        String first = id(ROBOT.formatted(1), empty);

        assertThat(first).isNotBlank().isEqualTo(id(ROBOT.formatted(1), empty));
        assertThat(id(ROBOT.formatted(2), empty)).isNotEqualTo(first);
        assertThat(id(null, empty)).isNotBlank().isNotEqualTo(first);
    }

    @Test
    void saysWhatIsNoEvent() {
        TopicRecord nothing = TopicRecord.of(Topics.RAW, 1_700_000_000_000L, "", null, Map.of());

        assertThatThrownBy(() -> RecognizeEvents.recognize(nothing))
                .isInstanceOfSatisfying(
                        UnreadableException.class,
                        why -> assertThat(why.reason()).isEqualTo(Reason.NOT_AN_EVENT));
    }

    private static String id(String value, String borne) throws UnreadableException {
        ReportedEvent event = RecognizeEvents.recognize(record(value, Map.of(HeaderNames.CE_ID, borne)));
        assertThat(event.record().headers()).containsEntry(HeaderNames.CE_ID, event.id());
        return event.id();
    }

    private static TopicRecord record(String value, Map<String, String> headers) {
        byte[] bytes = value == null ? null : value.getBytes(StandardCharsets.UTF_8);
        return TopicRecord.of(Topics.RAW, 1_700_000_000_000L, "r", bytes, headers);
    }
}
