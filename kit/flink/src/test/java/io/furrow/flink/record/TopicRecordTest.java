package io.furrow.flink.record;

import java.io.IOException;
import java.util.Map;
import java.util.Optional;

import org.apache.flink.api.common.serialization.SerializerConfigImpl;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.common.typeutils.TypeSerializerSnapshot;
import org.apache.flink.api.java.typeutils.runtime.PojoSerializerSnapshot;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.common.record.TimestampType;
import org.junit.jupiter.api.Test;

import io.furrow.flink.kafka.TopicRecordSchema;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TopicRecordTest {
    private static final TypeInformation<TopicRecord> TYPE = TypeInformation.of(TopicRecord.class);

    @Test
    void comesBackFromItsSerializerAlsoWithoutKeyAndValue() throws Exception {
        TypeSerializer<TopicRecord> serializer = TYPE.createSerializer(new SerializerConfigImpl());
        TopicRecord full = new TopicRecord("t", 3, 9, 77, utf8("k"), utf8("v"), Map.of("a", "ñ"));
        TopicRecord deletion = new TopicRecord("t", -1, -1, 0, null, null, Map.of());

        for (TopicRecord record : new TopicRecord[] {full, deletion}) {
            DataOutputSerializer out = new DataOutputSerializer(64);
            serializer.serialize(record, out);
            TopicRecord read = serializer.deserialize(new DataInputDeserializer(out.getCopyOfBuffer()));

            assertThat(read).usingRecursiveComparison().isEqualTo(record);
            assertThat(serializer.copy(record)).usingRecursiveComparison().isEqualTo(record);
        }
    }

    @Test
    void isReadInTheFormThatASavepointHolds() throws Exception {
        TypeSerializerSnapshot<TopicRecord> now =
                TYPE.createSerializer(new SerializerConfigImpl()).snapshotConfiguration();
        DataOutputSerializer savepoint = new DataOutputSerializer(64);
        TypeSerializerSnapshot.writeVersionedSnapshot(savepoint, now);
        byte[] said = savepoint.getCopyOfBuffer();

        TypeSerializerSnapshot<TopicRecord> stored =
                TypeSerializerSnapshot.readVersionedSnapshot(new DataInputDeserializer(said), loader());

        assertThat(now.resolveSchemaCompatibility(stored).isCompatibleAsIs()).isTrue();
        assertThat(now.resolveSchemaCompatibility(new PojoSerializerSnapshot<>())
                        .isIncompatible())
                .isTrue();
    }

    @Test
    void isNotReadInAFormThatIsNotKnown() {
        TypeSerializerSnapshot<TopicRecord> snapshot =
                TYPE.createSerializer(new SerializerConfigImpl()).snapshotConfiguration();

        assertThatThrownBy(() -> snapshot.readSnapshot(2, new DataInputDeserializer(new byte[0]), loader()))
                .isInstanceOf(IOException.class)
                .hasMessage(
                        "a format's snapshot of version 2 is unknown, known is 1; use the release that wrote it, or a newer one");
    }

    private static ClassLoader loader() {
        return TopicRecordTest.class.getClassLoader();
    }

    @Test
    void takesOverEveryPartOfAKafkaRecord() {
        RecordHeaders headers = new RecordHeaders();
        headers.add("a", utf8("first")).add("a", utf8("last")).add("none", null);
        ConsumerRecord<byte[], byte[]> in = new ConsumerRecord<>(
                "t", 2, 5, 77, TimestampType.CREATE_TIME, 1, 1, utf8("k"), utf8("v"), headers, Optional.empty());
        java.util.List<TopicRecord> out = new java.util.ArrayList<>();

        new TopicRecordSchema().deserialize(in, new org.apache.flink.api.common.functions.util.ListCollector<>(out));

        assertThat(out)
                .singleElement()
                .usingRecursiveComparison()
                .isEqualTo(new TopicRecord("t", 2, 5, 77, utf8("k"), utf8("v"), Map.of("a", "last", "none", "")));
        assertThat(out.get(0).position()).isEqualTo("t-2@5");
    }

    @Test
    void becomesAKafkaRecordWithTheKeysOwnPartition() {
        var record = TopicRecord.of("t", -1, "k", null, Map.of("a", "1")).with("b", "ñ");

        ProducerRecord<byte[], byte[]> out = new TopicRecordSchema().serialize(record, null, null);

        assertThat(out.topic()).isEqualTo("t");
        assertThat(out.partition()).isNull();
        assertThat(out.timestamp()).as("Kafka refuses a negative one").isZero();
        assertThat(out.key()).isEqualTo(utf8("k"));
        assertThat(out.value()).isNull();
        assertThat(out.headers().lastHeader("a").value()).isEqualTo(utf8("1"));
        assertThat(out.headers().lastHeader("b").value()).isEqualTo(utf8("ñ"));
    }

    @Test
    void hasOneTextForEachHeader() {
        TopicRecord record = TopicRecord.of("t", 0, "k", null, Map.of("a", "1", "b", "2"));

        TopicRecord other = record.with("b", "3").with("c", "4");

        assertThat(other.headers()).isEqualTo(Map.of("a", "1", "b", "3", "c", "4"));
        assertThat(other.headers().get("c")).isEqualTo("4");
        assertThat(other.headers().get("d")).isNull();
        assertThat(other.headers()).containsKey("a").doesNotContainKey("d");
        assertThat(record.headers()).isEqualTo(Map.of("a", "1", "b", "2"));
    }

    @Test
    void keepsTheOriginalBytesAsADeadLetter() {
        TopicRecord record = new TopicRecord("data.raw", 1, 42, 77, null, utf8("{"), Map.of("origin", "kafka"));

        TopicRecord dead = DeadLetters.of(record, new UnreadableException(Reason.NOT_JSON, "cut off"), "ingest");

        assertThat(dead)
                .usingRecursiveComparison()
                .isEqualTo(new TopicRecord(
                        "data.raw.dead",
                        1,
                        42,
                        77,
                        null,
                        utf8("{"),
                        Map.of(
                                "origin", "kafka",
                                "dead-reason", "not-json",
                                "dead-message", "cut off",
                                "dead-stage", "ingest",
                                "dead-source", "data.raw-1@42")));
        assertThat(record.headers()).as("the record itself").containsOnlyKeys("origin");
    }

    private static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }
}
