package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Notification;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EventTimeTest {
    private static final Instant RECEIVED = Instant.parse("2026-11-21T01:10:00Z");

    /** A PATCH without a time, as the context broker reports it: metadata TimeInstant is that of the measure before. */
    @Test
    void isThatOfTheNewestAttributeWithoutATimeOfTheDevice() throws Exception {
        String state = """
                {"id": "a", "type": "T", "dateModified": {"value": "2026-11-21T01:09:00.000Z"},
                 "x": {"value": 1, "metadata": {"dateModified": {"value": "2026-11-21T01:05:00.000Z"}}},
                 "y": {"value": 1, "metadata": {"TimeInstant": {"value": "2026-11-21T01:01:00.000Z"},
                   "dateModified": {"value": "2026-11-21T01:08:00.500Z"}}}}""";
        assertThat(time(state, "device,attributes,entity"))
                .isEqualTo(new EventTime(Instant.parse("2026-11-21T01:08:00.500Z"), EventTime.Basis.BROKER, null));
        assertThat(time(state, "entity,attributes").time()).isEqualTo(Instant.parse("2026-11-21T01:09:00Z"));
        assertThat(time(state, "device")).isEqualTo(new EventTime(RECEIVED, EventTime.Basis.RECEIPT, null));
    }

    @Test
    void isTheBrokersIfTheRuleSaysSo() throws Exception {
        String state = """
                {"id": "a", "TimeInstant": {"value": "2026-11-21T01:01:00.000Z"},
                 "dateModified": {"value": "2026-11-21T01:09:00.000Z"}}""";
        assertThat(time(state, "device,entity").time()).isEqualTo(Instant.parse("2026-11-21T01:01:00Z"));
        assertThat(time(state, "entity,device").time()).isEqualTo(Instant.parse("2026-11-21T01:09:00Z"));
    }

    @Test
    void rejectsInvalidOrders() {
        for (String order : List.of("", "clock", "device,device")) {
            assertThatThrownBy(() -> EventTimeRule.of(List.of(order.split(",")), Duration.ZERO))
                    .isInstanceOf(IllegalArgumentException.class);
        }
        assertThatThrownBy(() -> EventTimeRule.of(List.of("clock"), Duration.ZERO))
                .hasMessageContainingAll("'clock'", "device, attributes, entity");
    }

    private static EventTime time(String json, String order) throws Exception {
        Entity entity = Entity.parse(json.getBytes(UTF_8));
        return EventTime.of(entity, RECEIVED, EventTimeRule.of(List.of(order.split(",")), Duration.ofMinutes(5)));
    }

    @ParameterizedTest
    @CsvFileSource(resources = "event-times.csv", delimiter = '|', quoteCharacter = '\u0001')
    void followsTheCaseTable(String attributes, EventTime.Basis basis, EventTime.Fault fault, Instant time)
            throws Exception {
        byte[] body = ("{\"id\":\"a\"," + attributes + "}").getBytes(UTF_8);
        Entity entity =
                Notification.read(body, "simplifiedKeyValues").entities().get(0);

        assertThat(EventTime.of(entity, RECEIVED, EventTimeRule.within(Duration.ofMinutes(5))))
                .isEqualTo(new EventTime(time, basis, fault));
    }
}
