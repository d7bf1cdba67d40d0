package io.furrow.connect.sink;

import java.time.Instant;
import java.util.Date;
import java.util.Map;
import java.util.stream.Stream;

import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.connect.converters.ByteArrayConverter;
import org.apache.kafka.connect.data.SchemaAndValue;
import org.apache.kafka.connect.header.ConnectHeaders;
import org.apache.kafka.connect.json.JsonConverter;
import org.apache.kafka.connect.sink.SinkRecord;
import org.apache.kafka.connect.storage.HeaderConverter;
import org.apache.kafka.connect.storage.SimpleHeaderConverter;
import org.apache.kafka.connect.storage.StringConverter;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Headers mean the same whatever the header converter of the worker makes of them. */
class HeaderConvertersTest {
    private static final Instant EVENT = Instant.parse("2026-01-01T00:00:00.500Z");
    private static final long APPENDED = Instant.parse("2026-06-01T00:00:00Z").toEpochMilli();

    private final ChangeReader reader = new ChangeReader(FiwareScope.DEFAULT, "");

    static Stream<HeaderConverter> texts() {
        JsonConverter json = new JsonConverter();
        json.configure(Map.of("schemas.enable", "false"), false);
        return Stream.of(new StringConverter(), new ByteArrayConverter(), new SimpleHeaderConverter(), json);
    }

    @ParameterizedTest
    @MethodSource("texts")
    void tellTheEventTimeOnATopicThatStampsRecordsItself(HeaderConverter converter) throws Exception {
        String text = converter instanceof JsonConverter ? "\"" + EVENT + "\"" : EVENT.toString();
        SinkRecord record = record("ce_time", converter.toConnectHeader("t", "ce_time", text.getBytes()));

        assertThat(reader.read(record, 0).time()).isEqualTo(EVENT.toEpochMilli());
    }

    static Stream<Object> times() {
        return Stream.of(
                Date.from(EVENT),
                EVENT.toString(),
                "2026-01-01T01:00:00.5+01:00",
                EVENT.toString().getBytes(UTF_8),
                EVENT.toEpochMilli(),
                Long.toString(EVENT.toEpochMilli()));
    }

    @ParameterizedTest
    @MethodSource("times")
    void tellTheEventTimeInAnyType(Object time) throws Exception {
        assertThat(reader.read(record("ce_time", new SchemaAndValue(null, time)), 0)
                        .time())
                .isEqualTo(EVENT.toEpochMilli());
    }

    @ParameterizedTest
    @MethodSource("texts")
    void keepATenantOfDigitsOrSayThatTheyCannot(HeaderConverter converter) throws Exception {
        String text = converter instanceof JsonConverter ? "\"007\"" : "007";
        SinkRecord record = record("fiware-service", converter.toConnectHeader("t", "fiware-service", text.getBytes()));

        if (converter instanceof SimpleHeaderConverter) {
            assertThatThrownBy(() -> reader.read(record, 0))
                    .isInstanceOf(UnreadableException.class)
                    .hasMessageContainingAll(
                            "fiware-service", "header.converter=org.apache.kafka.connect.storage.StringConverter");
        } else {
            assertThat(reader.read(record, 0).key().scope().service()).isEqualTo("007");
        }
    }

    @Test
    void fallBackToTheRecordWhereTheyTellNoTime() throws Exception {
        assertThat(reader.read(record("ce_time", new SchemaAndValue(null, "soon")), 0)
                        .time())
                .isEqualTo(APPENDED);
    }

    private static SinkRecord record(String header, SchemaAndValue value) {
        ConnectHeaders headers = new ConnectHeaders();
        headers.add(header, value);
        byte[] entity = Entity.builder("a", "T").integer("x", 1).build().toBytes();
        return new SinkRecord("t", 0, null, "a", null, entity, 0, APPENDED, TimestampType.LOG_APPEND_TIME, headers);
    }
}
