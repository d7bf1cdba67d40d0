package io.furrow.kafka.secret;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Clock;
import java.util.List;
import java.util.Optional;
import java.util.Properties;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.file.PrivateFile;
import io.furrow.model.file.ReloadedFile;

/**
 * The file of a farm's secret, reloaded when it changes. A file with another secret than the farm's is rejected: the previous one
 * stays in use, with a log message.
 */
public final class SecretFile implements SecretSource {
    private static final Logger LOG = LoggerFactory.getLogger(SecretFile.class);

    private final SecretTopic topic;
    private final ReloadedFile<FarmSecret> file;
    private final Clock clock;

    private SecretFile(SecretTopic topic, ReloadedFile<FarmSecret> file, Clock clock) {
        this.topic = topic;
        this.file = file;
        this.clock = clock;
    }

    /**
     * Reads a file, without contacting Kafka.
     *
     * @param client settings of Kafka clients
     * @param replaced fingerprint of the farm's former secret, which this one replaces; null for none
     * @throws IOException if it cannot be read or is not a secret; the message says what to do
     */
    public static SecretFile open(Path file, Properties client, String replaced) throws IOException {
        return open(file, new SecretTopic(client, replaced), Clock.systemUTC());
    }

    public static SecretFile open(Path file, SecretTopic topic, Clock clock) throws IOException {
        Changes changes = new Changes(file, topic);
        return new SecretFile(topic, ReloadedFile.open(List.of(file), changes, LOG::warn), clock);
    }

    @Override
    public FarmSecret get() {
        return file.get().at(clock.instant());
    }

    @Override
    public Optional<String> problem() {
        return file.problem();
    }

    @Override
    public void verify() throws IOException {
        topic.claim(file.get());
    }

    /** Reads the file; from the second time on accepts only a secret of the farm. */
    private static final class Changes implements ReloadedFile.Source<FarmSecret> {
        private final Path file;
        private final SecretTopic topic;
        private boolean opened;

        Changes(Path file, SecretTopic topic) {
            this.file = file;
            this.topic = topic;
        }

        @Override
        public FarmSecret read() throws IOException {
            FarmSecret secret = FarmSecret.read(file);
            PrivateFile.exposure(file).ifPresent(LOG::warn);
            if (opened) {
                topic.claim(secret);
                LOG.info("the farm's secret was read again; its newest key is {}", secret);
            }
            opened = true;
            return secret;
        }
    }
}
