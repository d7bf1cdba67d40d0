package io.furrow.bench.http;

import java.net.InetSocketAddress;
import java.nio.ByteBuffer;
import java.time.Instant;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectMapper;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.ngsi.Notification;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class NotificationRequestTest {
    private static final InetSocketAddress TARGET = InetSocketAddress.createUnresolved("127.0.0.1", 8090);
    private static final long NOW = Instant.parse("2026-03-04T05:06:07.089Z").toEpochMilli();

    @ParameterizedTest
    @ValueSource(ints = {500, 733, 1000, 100_000})
    void hasABodyOfExactlyTheLengthThatItNames(int bytes) throws Exception {
        String request = text(NotificationRequest.to(TARGET, bytes, 10).with(1, NOW));

        assertThat(request).contains("Content-Length: " + bytes + "\r\n");
        assertThat(body(request)).hasSize(bytes);
        assertThat(Notification.read(body(request).getBytes(UTF_8), "normalized")
                        .entities())
                .hasSize(1);
    }

    @Test
    void writesNumberEntityAndTimesOverThoseOfTheRequestBefore() throws Exception {
        NotificationRequest request = NotificationRequest.to(TARGET, 1000, 10);
        request.with(99_999_999_999L, NOW - 86_400_000);

        JsonNode entity = entity(request.with(1_234_567L, NOW));

        assertThat(entity.path("id").asText()).isEqualTo("urn:ngsi-ld:SoilProbe:000007");
        assertThat(entity.at("/sequence/value").asLong()).isEqualTo(100_000_001_234_567L);
        assertThat(entity.at("/location/value/coordinates")).hasToString("[-3.7007,40.4]");
        assertThat(entity.findValues("TimeInstant"))
                .hasSizeGreaterThan(3)
                .allSatisfy(time -> assertThat(time.path("value").asText()).isEqualTo("2026-03-04T05:06:07.089Z"));
    }

    @Test
    void findsItsNumberInARecord() throws Exception {
        JsonNode entity = entity(NotificationRequest.to(TARGET, 1000, 10).with(77_000_000_123L, NOW));

        assertThat(NotificationRequest.numberIn(new ObjectMapper().writeValueAsBytes(entity)))
                .isEqualTo(77_000_000_123L);
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "{}", "\"sequence\":{\"type\":\"Number\",\"value\":12"})
    void findsNoNumberWhereThereIsNone(String record) {
        assertThat(NotificationRequest.numberIn(record.getBytes(UTF_8))).isEqualTo(-1);
    }

    @Test
    void refusesABodyThatIsTooShortForAnEntity() {
        assertThatThrownBy(() -> NotificationRequest.to(TARGET, 499, 10))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a body of 499 bytes is asked for, the least is 500");
    }

    private static JsonNode entity(ByteBuffer request) throws Exception {
        return new ObjectMapper().readTree(body(text(request))).at("/data/0");
    }

    private static String body(String request) {
        return request.substring(request.indexOf("\r\n\r\n") + 4);
    }

    private static String text(ByteBuffer request) {
        return UTF_8.decode(request).toString();
    }
}
