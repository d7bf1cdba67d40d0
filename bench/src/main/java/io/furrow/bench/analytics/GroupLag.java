package io.furrow.bench.analytics;

import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.ListOffsetsResult.ListOffsetsResultInfo;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.common.TopicPartition;

import io.furrow.bench.analytics.load.FleetTopic;

/** Measures the records of a topic that a job's consumer group has not committed; it commits at each checkpoint. */
final class GroupLag implements AutoCloseable {
    private final Admin admin;
    private final String topic;
    private final String group;

    GroupLag(Properties kafka, String topic, String job) {
        this.admin = Admin.create(kafka);
        this.topic = topic;
        this.group = "furrow-" + job;
    }

    long records() throws InterruptedException, ExecutionException {
        long done = admin.listConsumerGroupOffsets(group).partitionsToOffsetAndMetadata().get().values().stream()
                .mapToLong(OffsetAndMetadata::offset)
                .sum();
        return written(topic) - done;
    }

    /** Records of a partition that the group has committed; 0 before its first commit. */
    long committed(int partition) throws InterruptedException, ExecutionException {
        OffsetAndMetadata offset = admin.listConsumerGroupOffsets(group)
                .partitionsToOffsetAndMetadata()
                .get()
                .get(new TopicPartition(topic, partition));
        return offset == null ? 0 : offset.offset();
    }

    /** Number of records of a topic from which nothing was deleted. */
    long written(String topic) throws InterruptedException, ExecutionException {
        Map<TopicPartition, OffsetSpec> ends = IntStream.range(0, FleetTopic.PARTITIONS)
                .mapToObj(partition -> new TopicPartition(topic, partition))
                .collect(Collectors.toMap(partition -> partition, partition -> OffsetSpec.latest()));
        return admin.listOffsets(ends).all().get().values().stream()
                .mapToLong(ListOffsetsResultInfo::offset)
                .sum();
    }

    @Override
    public void close() {
        admin.close();
    }
}
