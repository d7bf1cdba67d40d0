package io.furrow.launcher.suite;

import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.common.errors.TopicExistsException;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.KafkaClient;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/** The Kafka cluster of a suite, embedded or external, and the settings of each kind of client. */
public final class KafkaAccess implements AutoCloseable {
    private static final int PARTITIONS = 4;
    private static final long SECONDS = 20;
    private static final Set<String> JOBS_READ = Set.of(Topics.RAW, Topics.NOTIFICATIONS);
    private static final List<String> TOPICS = Stream.concat(
                    Stream.of(
                            Topics.RAW,
                            Topics.dead(Topics.RAW),
                            Topics.NOTIFICATIONS,
                            Topics.CLOCKS,
                            Topics.CONTEXT,
                            Connectors.DEAD_RESULTS),
                    AnalyticsKind.allTopics())
            .toList();

    private final String bootstrapServers;
    private final Path propertiesFile;
    private final Properties properties;
    private final Admin admin;

    private KafkaAccess(String bootstrapServers, Path propertiesFile, Properties properties) {
        this.bootstrapServers = bootstrapServers;
        this.propertiesFile = propertiesFile;
        this.properties = properties;
        this.admin = Admin.create(clientProperties());
    }

    /** @param propertiesFile for every client; null for none */
    public static KafkaAccess to(String bootstrapServers, Path propertiesFile) {
        return new KafkaAccess(bootstrapServers, propertiesFile, KafkaClient.read(propertiesFile));
    }

    public String bootstrapServers() {
        return bootstrapServers;
    }

    /** For any Kafka client. */
    public Properties clientProperties() {
        Properties all = new Properties();
        all.putAll(properties);
        all.setProperty("bootstrap.servers", bootstrapServers);
        return all;
    }

    public Admin admin() {
        return admin;
    }

    Optional<Path> propertiesFile() {
        return Optional.ofNullable(propertiesFile);
    }

    /** For the Connect worker, which separates the settings of its own clients from those of connectors. */
    Map<String, String> connectSettings() {
        Map<String, String> settings = new HashMap<>();
        for (String name : properties.stringPropertyNames()) {
            for (String prefix : List.of("", "producer.", "consumer.", "admin.")) {
                settings.put(prefix + name, properties.getProperty(name));
            }
        }
        return settings;
    }

    /** Creates the topics that are read before the first write; existing ones stay unchanged. */
    void ensureTopics() throws InterruptedException {
        boolean isAlone = hasOneBroker();
        for (String topic : TOPICS) {
            NewTopic desired = new NewTopic(topic, Optional.of(PARTITIONS), Optional.empty());
            if (Topics.ofDeadLetters(topic).isPresent()) { // a letter is larger than the record that it was
                desired.configs(Map.of("max.message.bytes", Integer.toString(16 * 1024 * 1024)));
            } else if (isAlone
                    && JOBS_READ.contains(
                            topic)) { // a job's checkpoint must not be ahead of the topic after a power cut
                desired.configs(Map.of("flush.messages", "1"));
            }
            try {
                admin.createTopics(List.of(desired)).all().get(SECONDS, TimeUnit.SECONDS);
            } catch (ExecutionException e) {
                if (!(e.getCause() instanceof TopicExistsException)) {
                    throw new CommandException(
                            "Kafka at %s does not make topic %s: %s"
                                    .formatted(bootstrapServers, topic, FailureText.of(e.getCause())),
                            e);
                }
            } catch (TimeoutException e) {
                throw new CommandException(
                        "Kafka at %s does not answer. Check the address given with --kafka and that the broker runs."
                                .formatted(bootstrapServers),
                        e);
            }
        }
    }

    /** Without a replica, records that are not on disk are lost. */
    private boolean hasOneBroker() throws InterruptedException {
        try {
            return admin.describeCluster()
                            .nodes()
                            .get(SECONDS, TimeUnit.SECONDS)
                            .size()
                    == 1;
        } catch (ExecutionException | TimeoutException e) {
            return false; // the topics say what is wrong
        }
    }

    @Override
    public void close() {
        admin.close(java.time.Duration.ofSeconds(1));
    }
}
