package io.furrow.flink.kafka;

import java.util.List;
import java.util.Optional;

import org.apache.flink.connector.kafka.lineage.DefaultKafkaDatasetFacet;
import org.apache.flink.connector.kafka.lineage.DefaultKafkaDatasetIdentifier;
import org.apache.flink.connector.kafka.lineage.KafkaDatasetFacet;
import org.apache.flink.connector.kafka.lineage.KafkaDatasetFacetProvider;
import org.apache.flink.connector.kafka.sink.KafkaRecordSerializationSchema;

/**
 * Serializes records that name their topic. With exactly-once, a starting sink queries transactions that an earlier attempt left
 * open on the topics that its serializer names. This one names none: Kafka then lists all open ones that are visible to the job,
 * and the sink aborts those with its own prefix. Topics need not be known or readable, therefore.
 */
public interface AnyTopicSerializer<T> extends KafkaRecordSerializationSchema<T>, KafkaDatasetFacetProvider {
    @Override
    default Optional<KafkaDatasetFacet> getKafkaDatasetFacet() {
        return Optional.of(new DefaultKafkaDatasetFacet(DefaultKafkaDatasetIdentifier.ofTopics(List.of())));
    }
}
