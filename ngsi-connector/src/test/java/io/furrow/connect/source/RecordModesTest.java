package io.furrow.connect.source;

import java.time.Instant;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.connect.converters.ByteArrayConverter;
import org.apache.kafka.connect.json.JsonConverter;
import org.apache.kafka.connect.source.SourceRecord;
import org.apache.kafka.connect.storage.Converter;
import org.apache.kafka.connect.storage.StringConverter;
import org.apache.kafka.connect.transforms.ExtractField;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.source.journal.TaskJournals;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;

import static org.assertj.core.api.Assertions.assertThat;

/** What comes out of Connect's converters in each mode. */
class RecordModesTest {
    private static final Entity ENTITY =
            Entity.builder("urn:x:1", "T").integer("x", 5).build();
    private static final KafkaRecord CHANGE =
            new KafkaRecord("t", "urn:x:1", ENTITY.toBytes(), Instant.ofEpochMilli(7), Map.of("ce_id", "1"));
    private static final KafkaRecord DELETION =
            new KafkaRecord("t", "urn:x:1", null, Instant.ofEpochMilli(7), Map.of("ce_id", "2"));
    private static final byte[] NOT_UTF8 = {'{', (byte) 0xc3, '}'};

    @Test
    void isTheSameJsonAsBytesAndAsText() throws Exception {
        byte[] bytes = written(new ByteArrayConverter(), record("text", "bytes", CHANGE));
        byte[] text = written(new StringConverter(), record("text", "text", CHANGE));

        assertThat(bytes).isEqualTo(CHANGE.value());
        assertThat(text).isEqualTo(CHANGE.value());
    }

    @Test
    void isAnObjectOfFieldsThroughTheJsonConverter() throws Exception {
        SourceRecord record = record("text", "struct", CHANGE);

        JsonNode plain = NgsiJson.read(written(json(false), record));
        assertThat(plain.at("/id").textValue()).isEqualTo("urn:x:1");
        assertThat(plain.at("/attributes/x/numberValue").intValue()).isEqualTo(5);
        JsonNode enveloped = NgsiJson.read(written(json(true), record));
        assertThat(enveloped.at("/schema/name").textValue()).isEqualTo("io.furrow.ngsi.Entity");
        assertThat(enveloped.at("/payload")).isEqualTo(plain);
    }

    @Test
    void canBeTransformed() {
        try (ExtractField.Value<SourceRecord> type = new ExtractField.Value<>()) {
            type.configure(Map.of("field", "type"));

            assertThat(type.apply(record("text", "struct", CHANGE)).value()).isEqualTo("T");
        }
    }

    @ParameterizedTest
    @CsvSource({"text", "struct", "bytes"})
    void isNothingForADeletion(String mode) {
        SourceRecord record = record("text", mode, DELETION);

        assertThat(written(new ByteArrayConverter(), record)).isNull();
        if (!mode.equals("bytes")) {
            assertThat(written(json(true), record)).as("no envelope").isNull();
            assertThat(written(new StringConverter(), record)).isNull();
        }
    }

    @Test
    void keepsDeadLettersToTheByte() throws Exception {
        DeadLetter why = new DeadLetter(Reason.NOT_JSON, "byte 1", "ngsi-source", "here");
        KafkaRecord letter = new KafkaRecord("t.dead", null, NOT_UTF8, Instant.EPOCH, why.headers());

        assertThat(written(new ByteArrayConverter(), record("text", "bytes", letter)))
                .isEqualTo(NOT_UTF8);
        SourceRecord text = record("text", "text", letter);
        assertThat(written(new StringConverter(), text)).asString().isEqualTo("e8N9");
        assertThat(text.headers().lastWithName("dead-encoding").value()).isEqualTo("base64");
        assertThat(NgsiJson.read(written(json(false), record("text", "struct", letter))))
                .hasToString("{\"body\":\"e8N9\"}");
    }

    @Test
    void hasTheIdAsKeyForEitherKeyConverter() {
        SourceRecord text = record("text", "bytes", CHANGE);
        SourceRecord bytes = record("bytes", "bytes", CHANGE);

        assertThat(new StringConverter().fromConnectData("t", text.keySchema(), text.key()))
                .asString()
                .isEqualTo("urn:x:1");
        assertThat(new ByteArrayConverter().fromConnectData("t", bytes.keySchema(), bytes.key()))
                .asString()
                .isEqualTo("urn:x:1");
        assertThat(record("bytes", "bytes", new KafkaRecord("t", null, NOT_UTF8, Instant.EPOCH, Map.of()))
                        .key())
                .isNull();
    }

    @Test
    void leavesHeadersTimeAndOffsetsAsTheyAre() {
        for (String mode : List.of("bytes", "text", "struct")) {
            SourceRecord record = record("text", mode, CHANGE);
            assertThat(record.headers()).hasSize(1);
            assertThat(record.headers().lastWithName("ce_id").value()).isEqualTo("1");
            assertThat(record.timestamp()).isEqualTo(7);
            assertThat(SourceOffsets.sequenceOf(record.sourceOffset())).isEqualTo(3);
        }
    }

    private static SourceRecord record(String keyMode, String valueMode, KafkaRecord record) {
        SourceRecords records = new NgsiSourceConfig(
                        Map.of("journal.dir", "/tmp/journal", "key.mode", keyMode, "value.mode", valueMode))
                .records();
        JournalRecord kept = new JournalRecord(3, JournalRecordCodec.write(record));
        return records.of(new TaskJournals.Batch("j", List.of(kept)), each -> JournalRecordCodec.read(each.payload()))
                .get(0);
    }

    private static byte[] written(Converter converter, SourceRecord record) {
        return converter.fromConnectData(record.topic(), record.valueSchema(), record.value());
    }

    private static JsonConverter json(boolean withSchema) {
        JsonConverter json = new JsonConverter();
        json.configure(Map.of("schemas.enable", Boolean.toString(withSchema)), false);
        return json;
    }
}
