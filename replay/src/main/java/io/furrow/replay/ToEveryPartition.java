package io.furrow.replay;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.locks.LockSupport;

import org.apache.flink.api.common.functions.RichFlatMapFunction;
import org.apache.flink.util.Collector;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AdminClientConfig;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;

import io.furrow.flink.JobOptions;
import io.furrow.flink.TopicRecord;

/** Multiplies what ends an epoch: event time of a reader follows the slowest partition, so each one has to hear of it. */
final class ToEveryPartition extends RichFlatMapFunction<TopicRecord, TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final long RETRY_NANOS = Duration.ofMillis(100).toNanos();
    private static final Duration PATIENCE = Duration.ofMinutes(1);

    private final Properties client;
    private transient Admin admin;

    ToEveryPartition(JobOptions options) {
        client = options.kafkaProperties();
        client.setProperty(AdminClientConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        client.setProperty(AdminClientConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, Long.toString(PATIENCE.toMillis()));
    }

    @Override
    public void flatMap(TopicRecord record, Collector<TopicRecord> out) throws IOException, InterruptedException {
        if (!ReplayRecords.isEnd(record)) {
            out.collect(record);
            return;
        }
        int partitions = partitions(record.topic());
        for (int partition = 0; partition < partitions; partition++) {
            out.collect(record.toPartition(partition));
        }
    }

    /** Asked for each end: partitions may have been added. A broker that has not yet heard of a new topic is asked again. */
    private int partitions(String topic) throws IOException, InterruptedException {
        if (admin == null) {
            admin = Admin.create((Properties) client.clone());
        }
        long until = System.nanoTime() + PATIENCE.toNanos();
        while (true) {
            try {
                return admin.describeTopics(List.of(topic))
                        .allTopicNames()
                        .get()
                        .get(topic)
                        .partitions()
                        .size();
            } catch (ExecutionException e) {
                boolean unknown = e.getCause() instanceof UnknownTopicOrPartitionException;
                if (!unknown || System.nanoTime() > until) {
                    throw new IOException(
                            "the partitions of " + topic + " cannot be read: "
                                    + e.getCause().getMessage() + "; is the topic there, and may the job describe it?",
                            e.getCause());
                }
                LockSupport.parkNanos(RETRY_NANOS);
            }
        }
    }

    @Override
    public void close() {
        if (admin != null) {
            admin.close(Duration.ofSeconds(1));
        }
    }
}
