package io.furrow.control;

import java.io.IOException;
import java.time.Duration;
import java.util.Properties;

import org.apache.kafka.common.errors.RetriableException;
import org.apache.kafka.streams.CloseOptions;
import org.apache.kafka.streams.CloseOptions.GroupMembershipOperation;
import org.apache.kafka.streams.KafkaStreams;
import org.apache.kafka.streams.StreamsConfig;
import org.apache.kafka.streams.errors.StreamsUncaughtExceptionHandler.StreamThreadExceptionResponse;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Watches the farm in this JVM: health of devices, alarms, the entities of domains and missions. It is an application of its
 * own, so that managers answer whatever devices report. Several instances share the work as those of {@link ControlPlane} do.
 */
public final class FarmWatch implements AutoCloseable {
    /** Name of the group, first part of the names of its topics, of which state is rebuilt: never changed. */
    static final String APPLICATION = "furrow-farm-watch";

    private static final Logger LOG = LoggerFactory.getLogger(FarmWatch.class);
    private static final Duration PATIENCE = Duration.ofSeconds(30);

    private final KafkaStreams streams;

    private FarmWatch(KafkaStreams streams) {
        this.streams = streams;
    }

    /**
     * Makes the topics that are missing and starts.
     *
     * @throws IOException if the topics cannot be prepared; the message says what to do
     */
    public static FarmWatch start(ControlSettings settings, WatchOptions options) throws IOException {
        ServiceTopics.prepare(settings);
        Properties properties = settings.streams();
        properties.put(StreamsConfig.APPLICATION_ID_CONFIG, APPLICATION);
        KafkaStreams streams = new KafkaStreams(WatchTopology.of(settings.remembered(), options), properties);
        streams.setUncaughtExceptionHandler(FarmWatch::onFailure);
        streams.setStateListener((now, before) -> LOG.info("farm watch: {} (was {})", now, before));
        streams.start();
        return new FarmWatch(streams);
    }

    /** Kafka being away is no fault of ours; anything else would come again with the same record. */
    private static StreamThreadExceptionResponse onFailure(Throwable failure) {
        for (Throwable cause = failure; cause != null; cause = cause.getCause()) {
            if (cause instanceof RetriableException) {
                LOG.warn("the farm watch lost Kafka and goes on when that is back", failure);
                return StreamThreadExceptionResponse.REPLACE_THREAD;
            }
        }
        LOG.error("the farm watch stops; start it again once the cause is removed, nothing is lost", failure);
        return StreamThreadExceptionResponse.SHUTDOWN_CLIENT;
    }

    /** Whether it watches: it runs, and has its state, not being about to rebuild or to hand it over. */
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
            LOG.warn("the farm watch did not stop within {} s", PATIENCE.toSeconds());
        }
    }
}
