package io.furrow.control;

import java.time.Duration;
import java.util.Properties;

import org.apache.kafka.common.errors.RetriableException;
import org.apache.kafka.streams.CloseOptions;
import org.apache.kafka.streams.CloseOptions.GroupMembershipOperation;
import org.apache.kafka.streams.KafkaStreams;
import org.apache.kafka.streams.Topology;
import org.apache.kafka.streams.errors.MissingSourceTopicException;
import org.apache.kafka.streams.errors.StreamsUncaughtExceptionHandler.StreamThreadExceptionResponse;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** A topology at work in this JVM, alone or as one of several instances. */
final class StreamsApplication implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(StreamsApplication.class);
    private static final Duration PATIENCE = Duration.ofSeconds(30);

    private final String name;
    private final KafkaStreams streams;

    private StreamsApplication(String name, KafkaStreams streams) {
        this.name = name;
        this.streams = streams;
    }

    /** @param name for people, as in {@code control plane} */
    static StreamsApplication start(String name, Topology topology, Properties settings) {
        StreamsApplication application = new StreamsApplication(name, new KafkaStreams(topology, settings));
        application.streams.setUncaughtExceptionHandler(application::onFailure);
        application.streams.setStateListener((now, before) -> LOG.info("{}: {} (was {})", name, now, before));
        application.streams.start();
        return application;
    }

    /**
     * Kafka being away is no fault of ours, nor that a broker does not yet know of a topic that was made a moment ago; anything
     * else would come again with the same record.
     */
    private StreamThreadExceptionResponse onFailure(Throwable failure) {
        for (Throwable cause = failure; cause != null; cause = cause.getCause()) {
            if (cause instanceof RetriableException || cause instanceof MissingSourceTopicException) {
                LOG.warn("the {} lost Kafka, or a topic of it, and goes on when that is back", name, failure);
                return StreamThreadExceptionResponse.REPLACE_THREAD;
            }
        }
        LOG.error("the {} stops; start it again once the cause is removed, nothing is lost", name, failure);
        return StreamThreadExceptionResponse.SHUTDOWN_CLIENT;
    }

    /** Whether it runs, and has its state, not being about to rebuild or to hand it over. */
    boolean isHealthy() {
        return streams.state() == KafkaStreams.State.RUNNING;
    }

    /** {@code RUNNING}, {@code REBALANCING} and so on. */
    String state() {
        return streams.state().name();
    }

    /** Finishes what it is at and leaves; another instance takes over at once. */
    @Override
    public void close() {
        if (!streams.close(
                CloseOptions.timeout(PATIENCE).withGroupMembershipOperation(GroupMembershipOperation.LEAVE_GROUP))) {
            LOG.warn("the {} did not stop within {} s", name, PATIENCE.toSeconds());
        }
    }
}
