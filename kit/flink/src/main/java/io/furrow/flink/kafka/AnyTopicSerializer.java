package io.furrow.flink.kafka;

import java.util.List;
import java.util.Optional;

import org.apache.flink.connector.kafka.lineage.DefaultKafkaDatasetFacet;
import org.apache.flink.connector.kafka.lineage.DefaultKafkaDatasetIdentifier;
import org.apache.flink.connector.kafka.lineage.KafkaDatasetFacet;
import org.apache.flink.connector.kafka.lineage.KafkaDatasetFacetProvider;
import org.apache.flink.connector.kafka.sink.KafkaRecordSerializationSchema;

/**
 * Serializes records that name their topic. With exactly-once the sink asks, when it starts, for transactions that an earlier
 * attempt left open on the topics that its serializer names. This one names none: Kafka then lists all that are open and that the
 * job may see, and the sink aborts those that bear its own prefix. So topics need not be known, nor readable.
 */
public interface AnyTopicSerializer<T> extends KafkaRecordSerializationSchema<T>, KafkaDatasetFacetProvider {
    @Override
    default Optional<KafkaDatasetFacet> getKafkaDatasetFacet() {
        return Optional.of(new DefaultKafkaDatasetFacet(DefaultKafkaDatasetIdentifier.ofTopics(List.of())));
    }
}
