package io.furrow.flink.kafka;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.connector.kafka.source.reader.deserializer.KafkaRecordDeserializationSchema;
import org.apache.flink.util.Collector;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.flink.record.TextHeaders;
import io.furrow.flink.record.TopicRecord;

/** Converts between Kafka's records and {@link TopicRecord}, without parsing key or value. */
public final class TopicRecordSchema
        implements KafkaRecordDeserializationSchema<TopicRecord>, AnyTopicSerializer<TopicRecord> {
    private static final long serialVersionUID = 1L;

    @Override
    public void deserialize(ConsumerRecord<byte[], byte[]> in, Collector<TopicRecord> out) {
        TextHeaders headers = TextHeaders.of(in.headers().toArray());
        out.collect(new TopicRecord(
                in.topic(), in.partition(), in.offset(), in.timestamp(), in.key(), in.value(), headers));
    }

    @Override
    public ProducerRecord<byte[], byte[]> serialize(TopicRecord record, KafkaSinkContext context, Long timestamp) {
        return new ProducerRecord<>(
                record.topic(),
                record.offset() < 0 && record.partition() >= 0 ? record.partition() : null,
                Math.max(0, record.timestamp()),
                record.key(),
                record.value(),
                TextHeaders.of(record.headers()).bytes());
    }

    @Override
    public TypeInformation<TopicRecord> getProducedType() {
        return TypeInformation.of(TopicRecord.class);
    }
}
