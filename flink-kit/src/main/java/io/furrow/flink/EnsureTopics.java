package io.furrow.flink;

import java.io.IOException;
import java.time.Duration;
import java.util.HashSet;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.functions.RichMapFunction;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AdminClientConfig;
import org.apache.kafka.common.errors.AuthorizationException;
import org.apache.kafka.common.errors.TopicExistsException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Passes records on unchanged, and makes the topic of the first record for it where it is not there. Asks once per topic; an
 * unreachable broker is asked again for a minute, then the job fails and is restarted.
 */
public final class EnsureTopics extends RichMapFunction<TopicRecord, TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(EnsureTopics.class);
    private static final Duration PATIENCE = Duration.ofMinutes(1);

    private final Properties client;
    private final TopicOptions.Settings settings;
    private transient Admin admin;
    private transient Set<String> known;

    public EnsureTopics(JobOptions options, TopicOptions.Settings settings) {
        this.settings = settings;
        this.client = options.kafkaProperties();
        client.setProperty(AdminClientConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        client.setProperty(AdminClientConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, Long.toString(PATIENCE.toMillis()));
    }

    @Override
    public void open(OpenContext context) {
        known = new HashSet<>();
    }

    @Override
    public TopicRecord map(TopicRecord record) throws IOException, InterruptedException {
        if (!known.contains(record.topic())) {
            ensure(record.topic());
            known.add(record.topic());
        }
        return record;
    }

    private void ensure(String topic) throws IOException, InterruptedException {
        if (admin == null) {
            admin = Admin.create(client);
        }
        try {
            admin.createTopics(List.of(settings.topic(topic))).all().get();
            LOG.info("Made topic {}", topic);
        } catch (ExecutionException e) {
            if (!(e.getCause() instanceof TopicExistsException) && !isAllowedOnlyToWrite(topic, e.getCause())) {
                throw new IOException(
                        "topic " + topic + " could not be made: " + e.getCause().getMessage()
                                + "; see --topic-partitions, --topic-replication, --topic-retention, or make it yourself",
                        e.getCause());
            }
        }
    }

    /** Who may not make topics may still write to those that others made. */
    private boolean isAllowedOnlyToWrite(String topic, Throwable refusal) throws InterruptedException {
        if (!(refusal instanceof AuthorizationException)) {
            return false;
        }
        try {
            admin.describeTopics(List.of(topic)).allTopicNames().get();
            return true;
        } catch (ExecutionException e) {
            LOG.warn("Topic {} is not there, or may not be seen", topic, e.getCause());
            return false;
        }
    }

    @Override
    public void close() {
        if (admin != null) {
            admin.close(Duration.ofSeconds(1));
        }
    }
}
