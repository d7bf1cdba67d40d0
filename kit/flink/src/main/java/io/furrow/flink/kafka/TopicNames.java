package io.furrow.flink.kafka;

import java.io.IOException;
import java.io.Serializable;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AdminClientConfig;

import io.furrow.flink.job.JobOptions;

/** Lists the existing topics at the moment of the call. */
public interface TopicNames extends Serializable {
    /** For a job that creates none. */
    TopicNames NONE = Set::of;

    Set<String> read() throws IOException;

    /** The topics of the configured Kafka. */
    static TopicNames ofKafka(JobOptions options) {
        Properties client = options.kafkaProperties();
        client.setProperty(AdminClientConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        return () -> {
            try (Admin admin = Admin.create(client)) {
                return admin.listTopics().names().get();
            } catch (ExecutionException e) {
                throw new IOException("Kafka does not say which topics there are; does it respond?", e.getCause());
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
                throw new IOException("interrupted while Kafka was asked for its topics", e);
            }
        };
    }
}
