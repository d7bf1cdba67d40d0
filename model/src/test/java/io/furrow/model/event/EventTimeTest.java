package io.furrow.model.event;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Notification;

import static org.assertj.core.api.Assertions.assertThat;

class EventTimeTest {
    private static final Instant RECEIVED = Instant.parse("2026-11-21T01:10:00Z");

    @ParameterizedTest
    @CsvFileSource(resources = "event-times.csv", delimiter = '|', quoteCharacter = '\u0001')
    void followsTheCaseTable(String attributes, EventTime.Basis basis, Instant time) throws Exception {
        byte[] body = ("{\"id\":\"a\"," + attributes + "}").getBytes(StandardCharsets.UTF_8);
        Entity entity =
                Notification.read(body, "simplifiedKeyValues").entities().get(0);

        assertThat(EventTime.of(entity, RECEIVED, Duration.ofMinutes(5))).isEqualTo(new EventTime(time, basis));
    }
}
