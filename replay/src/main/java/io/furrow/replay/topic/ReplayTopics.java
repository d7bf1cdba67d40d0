package io.furrow.replay.topic;

import java.io.IOException;
import java.io.Serializable;
import java.util.Collection;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerConfig;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.EnsureTopics;
import io.furrow.flink.kafka.LimitRecordSize;
import io.furrow.flink.kafka.TopicOptions;
import io.furrow.flink.record.TopicRecord;

/** Where replays are played. Serializable, so that a job can carry it. */
public interface ReplayTopics extends Serializable {
    /** For the lifetime of a reader. */
    Writing open();

    /** What a reader writes to. */
    interface Writing extends AutoCloseable {
        /**
         * Makes the topic where it is not there, and waits for the broker; from any thread.
         *
         * @return its partitions
         * @throws IOException if that cannot be done now; the message says what to do
         */
        int prepare(String topic) throws IOException, InterruptedException;

        /**
         * The newest of what the topic has, committed or not; from any thread.
         *
         * @throws IOException if that cannot be read now
         */
        TopicEnd end(String topic) throws IOException, InterruptedException;

        /**
         * The broker's ids of those topics that it has heard of: a topic that is made again has another; from any thread.
         *
         * @throws IOException if that cannot be asked now
         */
        Map<String, String> ids(Collection<String> topics) throws IOException, InterruptedException;

        /** The record, or what is written in its place because the topic does not take it. */
        TopicRecord writable(TopicRecord record) throws IOException, InterruptedException;

        @Override
        void close();
    }

    /** The topics of a job on Kafka. */
    static ReplayTopics of(JobOptions options, TopicOptions.Settings settings) {
        Properties client = options.kafkaProperties();
        client.setProperty(ConsumerConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        return new OnKafka(new EnsureTopics(options, settings), new TopicEndReader(client));
    }

    /** Topics are made as the job's options say. */
    record OnKafka(EnsureTopics topics, TopicEndReader ends) implements ReplayTopics {
        @Override
        public Writing open() {
            LimitRecordSize records = topics.writable();
            return new Writing() {
                @Override
                public int prepare(String topic) throws IOException, InterruptedException {
                    return records.prepare(topic);
                }

                @Override
                public Map<String, String> ids(Collection<String> names) throws IOException, InterruptedException {
                    return records.ids(names);
                }

                @Override
                public TopicEnd end(String topic) throws IOException, InterruptedException {
                    return ends.of(topic);
                }

                @Override
                public TopicRecord writable(TopicRecord record) throws IOException, InterruptedException {
                    return records.of(record);
                }

                @Override
                public void close() {
                    records.close();
                }
            };
        }
    }
}
