package io.furrow.control;

import java.io.IOException;
import java.time.Duration;

import org.apache.kafka.common.errors.RetriableException;
import org.apache.kafka.streams.CloseOptions;
import org.apache.kafka.streams.CloseOptions.GroupMembershipOperation;
import org.apache.kafka.streams.KafkaStreams;
import org.apache.kafka.streams.errors.StreamsUncaughtExceptionHandler.StreamThreadExceptionResponse;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The three managers in this JVM. Several instances of the same settings share the work: the managers of domains and of missions
 * are one task, that of replays another; what an instance had when it died another takes over.
 */
public final class ControlPlane implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ControlPlane.class);
    private static final Duration PATIENCE = Duration.ofSeconds(30);

    private final KafkaStreams streams;

    private ControlPlane(KafkaStreams streams) {
        this.streams = streams;
    }

    /**
     * Prepares the topics and starts; requests are answered once {@link #isHealthy()}.
     *
     * @throws IOException if the topics cannot be prepared; the message says what to do
     */
    public static ControlPlane start(ControlSettings settings) throws IOException {
        ServiceTopics.prepare(settings);
        KafkaStreams streams =
                new KafkaStreams(ControlTopology.of(settings.remembered(), settings.missions()), settings.streams());
        streams.setUncaughtExceptionHandler(ControlPlane::onFailure);
        streams.setStateListener((now, before) -> LOG.info("control plane: {} (was {})", now, before));
        streams.start();
        return new ControlPlane(streams);
    }

    /** Kafka being away is no fault of ours; anything else would come again with the same record. */
    private static StreamThreadExceptionResponse onFailure(Throwable failure) {
        for (Throwable cause = failure; cause != null; cause = cause.getCause()) {
            if (cause instanceof RetriableException) {
                LOG.warn("the control plane lost Kafka and goes on when that is back", failure);
                return StreamThreadExceptionResponse.REPLACE_THREAD;
            }
        }
        LOG.error("the control plane stops; start it again once the cause is removed, nothing is lost", failure);
        return StreamThreadExceptionResponse.SHUTDOWN_CLIENT;
    }

    /** Whether it answers requests: it runs, and has its state, not being about to rebuild or to hand it over. */
    public boolean isHealthy() {
        return streams.state() == KafkaStreams.State.RUNNING;
    }

    /** For a health page: {@code RUNNING}, {@code REBALANCING} and so on. */
    public String state() {
        return streams.state().name();
    }

    /** Finishes what it is at and leaves; another instance takes over at once. */
    @Override
    public void close() {
        if (!streams.close(
                CloseOptions.timeout(PATIENCE).withGroupMembershipOperation(GroupMembershipOperation.LEAVE_GROUP))) {
            LOG.warn("the control plane did not stop within {} s", PATIENCE.toSeconds());
        }
    }
}
