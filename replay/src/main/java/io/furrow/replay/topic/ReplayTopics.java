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

/** Gives access to the topics of replays. Serializable, so that a job can carry it. */
public interface ReplayTopics extends Serializable {
    /** Opens the topics for the lifetime of a reader. */
    Writing open();

    /** The topics as a reader uses them, from any thread. */
    interface Writing extends AutoCloseable {
        /**
         * Creates the topic if it does not exist, and waits for the broker.
         *
         * @return its number of partitions
         * @throws IOException if that is not possible now; the message says what to do
         */
        int prepare(String topic) throws IOException, InterruptedException;

        /**
         * Reads the greatest epoch and timestamp of the topic, committed or not.
         *
         * @throws IOException if the topic cannot be read now
         */
        TopicEnd end(String topic) throws IOException, InterruptedException;

        /**
         * Returns the ids of those topics that exist; a topic that is created again has another id.
         *
         * @throws IOException if the broker is unavailable
         */
        Map<String, String> ids(Collection<String> topics) throws IOException, InterruptedException;

        /** Returns the record, or a dead letter if the record is too large for its topic. */
        TopicRecord writable(TopicRecord record) throws IOException, InterruptedException;

        @Override
        void close();
    }

    /** Returns the topics of a job on Kafka. */
    static ReplayTopics of(JobOptions options, TopicOptions.Settings settings) {
        Properties client = options.kafkaProperties();
        client.setProperty(ConsumerConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        return new OnKafka(new EnsureTopics(options, settings), new TopicEndReader(client));
    }

    /** Creates topics as the job's options say. */
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
