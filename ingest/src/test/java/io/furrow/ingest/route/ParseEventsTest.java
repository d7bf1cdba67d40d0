package io.furrow.ingest.route;

import java.time.Duration;
import java.util.List;
import java.util.Map;

import org.apache.flink.streaming.api.operators.ProcessOperator;
import org.apache.flink.streaming.util.OneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ParseEventsTest {
    private static final String ROBOT = "{\"id\":\"r\",\"type\":\"Robot\",\"n\":{\"value\":%d}}";

    @Test
    void keepsTheIdThatAnEventBears() throws Exception {
        ReportedEvent event = ParseEvents.recognize(record(ROBOT.formatted(1), Map.of(HeaderNames.CE_ID, "a")));

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

    /** A device may write the name of a mission as a number. */
    @Test
    void readsNamesThatAreNumbers() throws Exception {
        String named = "{\"id\":\"r\",\"Domain\":{\"value\":%s},\"Mission\":{\"value\":%s}}";
        ReportedEvent event = ParseEvents.recognize(record(named.formatted("\"north\"", "7"), Map.of()));
        ReportedEvent other =
                ParseEvents.recognize(record(named.formatted("2.026e3", "7.5"), Map.of(HeaderNames.CE_ID, "a")));

        assertThat(event.domain() + "/" + event.mission()).isEqualTo("north/7");
        assertThat(other.domain() + "/" + other.mission()).isEqualTo("2026/");
    }

    @Test
    void saysWhatIsNoEvent() {
        TopicRecord nothing = TopicRecord.of(Topics.RAW, 1_700_000_000_000L, "", null, Map.of());

        assertThatThrownBy(() -> ParseEvents.recognize(nothing))
                .isInstanceOfSatisfying(
                        UnreadableException.class,
                        why -> assertThat(why.reason()).isEqualTo(Reason.NOT_AN_EVENT));
    }

    @Test
    void countsIdsOfSeveralTenantsThatShareAKeyOfTheNewest() throws Exception {
        assertThat(idsShared(true)).isEqualTo(1);
        assertThat(idsShared(false)).isZero();
    }

    private static long idsShared(boolean keysById) throws Exception {
        ParseEvents recognize = new ParseEvents(
                new ClockSkewLimit(new ReceiptTime(Duration.ofSeconds(10)), Duration.ofDays(20_000)), keysById);
        OneInputStreamOperatorTestHarness<TopicRecord, ReportedEvent> harness =
                new OneInputStreamOperatorTestHarness<>(new ProcessOperator<>(recognize));
        harness.open();
        for (String tenant : List.of("one", "one", "other", "other", "one", "other", "one")) {
            harness.processElement(record(ROBOT.formatted(1), Map.of(HeaderNames.SERVICE, tenant)), 1);
            String own = "{\"id\":\"own-%s\",\"type\":\"Robot\"}".formatted(tenant);
            harness.processElement(record(own, Map.of(HeaderNames.SERVICE, tenant)), 1);
        }
        assertThat(harness.extractOutputValues()).hasSize(14);
        long shared = recognize.idsShared();
        harness.close();
        return shared;
    }

    private static String id(String value, String borne) throws UnreadableException {
        ReportedEvent event = ParseEvents.recognize(record(value, Map.of(HeaderNames.CE_ID, borne)));
        assertThat(event.record().headers()).containsEntry(HeaderNames.CE_ID, event.id());
        return event.id();
    }

    private static TopicRecord record(String value, Map<String, String> headers) {
        byte[] bytes = value == null ? null : value.getBytes(UTF_8);
        return TopicRecord.of(Topics.RAW, 1_700_000_000_000L, "r", bytes, headers);
    }
}
