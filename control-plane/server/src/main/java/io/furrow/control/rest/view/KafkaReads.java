package io.furrow.control.rest.view;

import java.io.IOException;
import java.util.concurrent.Semaphore;

import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.InvalidTopicException;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.text.FailureText;

/** Limits concurrent reads from Kafka for requests, and answers their failures. */
public final class KafkaReads {
    private final Semaphore permits;

    /** @param max number of concurrent reads */
    public KafkaReads(int max) {
        permits = new Semaphore(max);
    }

    /** A read. */
    @FunctionalInterface
    public interface Read<T> {
        T run() throws IOException;
    }

    /** @throws ProblemException if too many are running, there is no such topic, or Kafka does not answer */
    public <T> T run(Read<T> read) {
        if (!permits.tryAcquire()) {
            throw ProblemException.overloaded();
        }
        try {
            return unlimited(read);
        } finally {
            permits.release();
        }
    }

    /** @throws ProblemException as {@link #run}, except if too many are running */
    public static <T> T unlimited(Read<T> read) {
        try {
            return read.run();
        } catch (UnknownTopicOrPartitionException | InvalidTopicException e) {
            throw new ProblemException(404, "unknown-topic", e.getMessage());
        } catch (IOException | KafkaException e) {
            throw new ProblemException(
                    503,
                    "kafka-away",
                    "Kafka does not answer or refuses (%s); check that it runs, and what the control plane may do there"
                            .formatted(FailureText.of(e)));
        }
    }
}
