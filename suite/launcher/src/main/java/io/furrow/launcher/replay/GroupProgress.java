package io.furrow.launcher.replay;

import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.ListOffsetsOptions;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.admin.TopicDescription;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.common.IsolationLevel;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;

import io.furrow.cli.control.ReplayAnalyticsJob;

/** Determines the progress of jobs from the offsets that their consumer groups commit with each checkpoint. */
final class GroupProgress implements JobProgress.Source, AutoCloseable {
    private static final Duration TIMEOUT = Duration.ofSeconds(20);

    private final Admin admin;

    /** @param client settings of Kafka clients, with {@code bootstrap.servers} */
    GroupProgress(Properties client) {
        this.admin = Admin.create(client);
    }

    @Override
    public JobProgress of(ReplayAnalyticsJob job) throws AnalyticsException {
        try {
            TopicDescription topic = done(admin.describeTopics(java.util.List.of(job.topic()))
                    .topicNameValues()
                    .get(job.topic()));
            Map<TopicPartition, OffsetSpec> all = new HashMap<>();
            topic.partitions()
                    .forEach(one -> all.put(new TopicPartition(job.topic(), one.partition()), OffsetSpec.latest()));
            Map<TopicPartition, OffsetAndMetadata> committed =
                    done(admin.listConsumerGroupOffsets(job.group()).partitionsToOffsetAndMetadata());
            long end = 0;
            long read = 0;
            for (var one : done(admin.listOffsets(all, new ListOffsetsOptions(IsolationLevel.READ_COMMITTED))
                            .all())
                    .entrySet()) {
                end += one.getValue().offset();
                OffsetAndMetadata position = committed.get(one.getKey());
                read += position == null ? 0 : position.offset();
            }
            return new JobProgress(read, end);
        } catch (ExecutionException e) {
            if (e.getCause() instanceof UnknownTopicOrPartitionException) {
                return null;
            }
            throw new AnalyticsException("How far %s is cannot be asked of Kafka".formatted(job.name()), e.getCause());
        } catch (TimeoutException e) {
            throw new AnalyticsException(
                    "Kafka does not say within %d s how far %s is".formatted(TIMEOUT.toSeconds(), job.name()), e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new AnalyticsException("interrupted while asking how far " + job.name() + " is", e);
        }
    }

    private static <T> T done(KafkaFuture<T> future) throws InterruptedException, ExecutionException, TimeoutException {
        return future.get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
    }

    @Override
    public void close() {
        admin.close(Duration.ofSeconds(1));
    }
}
