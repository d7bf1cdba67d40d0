package io.furrow.kafka.secret;

import java.io.IOException;
import java.time.Duration;
import java.util.Optional;
import java.util.Properties;
import java.util.concurrent.ThreadLocalRandom;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.AuthorizationException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.SecretFingerprints;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * The fingerprints of the farm's secret on {@code service.secrets}. A process writes a record only after reading the previous one,
 * and if no other has written since: of two processes with different secrets on a new farm exactly one succeeds, and the other is
 * rejected. The transactional id ensures this: Kafka allows one producer with it at a time.
 */
public final class SecretTopic {
    private static final Logger LOG = LoggerFactory.getLogger(SecretTopic.class);
    private static final String TRANSACTIONS = "furrow-secrets";
    private static final int TIMEOUT_MS = 15_000;
    private static final Duration CLAIM_TIMEOUT = Duration.ofSeconds(30);
    private static final long MAX_BACKOFF_MS = 1_000;

    private final Properties client;
    private final String replaced;

    /**
     * @param client settings of Kafka clients
     * @param replaced fingerprint of the newest key of the secret that may be replaced; null for none
     */
    public SecretTopic(Properties client, String replaced) {
        this.client = client;
        this.replaced = replaced;
    }

    /**
     * Makes a secret that of the farm if the farm has none, or an earlier rotation of it; otherwise checks that it is.
     *
     * @throws IOException if the farm has another or a newer one, or Kafka does not answer; the message says what to do
     */
    public void claim(FarmSecret secret) throws IOException {
        SecretFingerprints own = SecretFingerprints.of(secret);
        try {
            long deadline = System.nanoTime() + CLAIM_TIMEOUT.toNanos();
            while (!isAgreed(own, read()) && !isWritten(own, deadline)) {
                // Random, so that two processes do not continue to fence each other.
                Thread.sleep(ThreadLocalRandom.current().nextLong(MAX_BACKOFF_MS));
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IOException("the check of the farm's secret was interrupted", e);
        } catch (KafkaException | UnreadableException e) {
            throw new IOException(
                    "it cannot be found out whether the secret of this process, %s, is that of the farm: %s at %s (%s)"
                            .formatted(own, Topics.SECRETS, client.get("bootstrap.servers"), FailureText.of(e)),
                    e);
        }
    }

    /** @return whether nothing has to be written */
    private boolean isAgreed(SecretFingerprints own, Optional<SecretFingerprints> farms) throws IOException {
        if (farms.isEmpty()) {
            return false;
        }
        SecretFingerprints known = farms.get();
        return switch (own.to(known)) {
            case SAME -> true;
            case NEWER -> false;
            case OLDER ->
                throw new IOException(
                        "the farm's secret was rotated: its newest key is %s, that of this process %s. Give this process a copy of the newest file"
                                .formatted(known, own));
            case ANOTHER -> {
                if (known.fingerprint().equals(replaced)) {
                    yield false;
                }
                throw new IOException(
                        ("this farm has another secret: its newest key is %s, that of this process %s; with it no device would be let in any more."
                                        + " Name the file of the farm (./furrow secret show FILE prints its fingerprint). If that is lost: start once"
                                        + " with --replace-farm-secret %s, and give every device new credentials")
                                .formatted(known, own, known.fingerprint()));
            }
        };
    }

    /**
     * Returns false after a conflict with another process: the error then depends on this producer's operation, and is not always a
     * fenced producer, but it can be retried after reading again.
     */
    private boolean isWritten(SecretFingerprints own, long deadline) throws IOException, UnreadableException {
        try {
            write(own);
            return true;
        } catch (KafkaException e) {
            if (e instanceof AuthorizationException || System.nanoTime() > deadline) {
                throw e;
            }
            LOG.debug("{} could not be written; retrying", Topics.SECRETS, e);
            return false;
        }
    }

    private void write(SecretFingerprints own) throws IOException, UnreadableException {
        Properties settings = settings();
        settings.put("transactional.id", TRANSACTIONS);
        settings.put("enable.idempotence", "true");
        settings.put("acks", "all");
        try (KafkaProducer<String, byte[]> producer = KafkaClients.producer(settings)) {
            // Fences earlier producers; their records can be read from here on.
            producer.initTransactions();
            if (isAgreed(own, read())) {
                return;
            }
            producer.beginTransaction();
            producer.send(new ProducerRecord<>(Topics.SECRETS, SecretFingerprints.KEY, own.toBytes()));
            producer.commitTransaction();
        }
    }

    private Optional<SecretFingerprints> read() throws UnreadableException {
        AtomicReference<byte[]> newest = new AtomicReference<>();
        try (CommittedReader<String> reader = CommittedReader.open(settings(), Topics.SECRETS)) {
            reader.readToEnd(record -> {
                if (SecretFingerprints.KEY.equals(record.key())) {
                    newest.set(record.value());
                }
            });
        }
        return newest.get() == null ? Optional.empty() : Optional.of(SecretFingerprints.read(newest.get()));
    }

    private Properties settings() {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.put("default.api.timeout.ms", Integer.toString(TIMEOUT_MS));
        settings.put("request.timeout.ms", Integer.toString(TIMEOUT_MS));
        settings.put("max.block.ms", Integer.toString(TIMEOUT_MS));
        settings.put("allow.auto.create.topics", "false");
        return settings;
    }
}
