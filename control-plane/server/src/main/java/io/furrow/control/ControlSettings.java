package io.furrow.control;

import java.time.Duration;
import java.util.Properties;

import org.apache.kafka.streams.StreamsConfig;

import io.furrow.control.manager.FailureHandler;
import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.model.control.Limits;
import io.furrow.model.event.FiwareScope;

/**
 * What the control plane is started with.
 *
 * @param client settings of Kafka clients, {@code bootstrap.servers} among them
 * @param standbyReplicas how many further instances hold a copy of all state, ready to take over; 0 with a single instance
 * @param replicationFactor of the topics that it makes; -1 for the broker's default
 * @param remembered how long ids of requests are, so that a second request of the same id has no effect
 * @param missions how missions are run
 * @param replays how replays are managed
 */
public record ControlSettings(
        Properties client,
        int standbyReplicas,
        short replicationFactor,
        Duration remembered,
        MissionSettings missions,
        ReplaySettings replays) {
    /** Name of the group, first part of the names of its topics, of which state is rebuilt: never changed. */
    static final String APPLICATION = "furrow-control-plane";

    /** A rebalance waits no longer for a member that does not join; the default of five minutes is as long as nobody would be answered. */
    private static final Duration REBALANCE_TIMEOUT = Duration.ofSeconds(60);

    private static final Duration TAKEN_OVER_AFTER = Duration.ofSeconds(10);

    /**
     * The first batch of a transaction may be refused for as long as the broker still writes the markers of the one before; a second
     * in flight behind it would then come out of order, which broker and client log as an error before they try again.
     */
    private static final int IN_FLIGHT = 1;

    /** One instance; requests are remembered for an hour, devices have a minute to come up. */
    public static ControlSettings of(Properties client) {
        return new ControlSettings(
                client,
                0,
                (short) -1,
                Duration.ofHours(1),
                new MissionSettings(MissionSettings.START_TIMEOUT, FiwareScope.DEFAULT, false),
                ReplaySettings.DEFAULT);
    }

    public ControlSettings with(MissionSettings newMissions) {
        return new ControlSettings(client, standbyReplicas, replicationFactor, remembered, newMissions, replays);
    }

    public ControlSettings withStandbyReplicas(int replicas) {
        return new ControlSettings(client, replicas, replicationFactor, remembered, missions, replays);
    }

    public ControlSettings withReplicationFactor(short factor) {
        return new ControlSettings(client, standbyReplicas, factor, remembered, missions, replays);
    }

    public ControlSettings with(ReplaySettings newReplays) {
        return new ControlSettings(client, standbyReplicas, replicationFactor, remembered, missions, newReplays);
    }

    Properties streams() {
        Properties streams = new Properties();
        streams.putAll(client);
        streams.put(StreamsConfig.APPLICATION_ID_CONFIG, APPLICATION);
        streams.put(StreamsConfig.PROCESSING_GUARANTEE_CONFIG, StreamsConfig.EXACTLY_ONCE_V2);
        streams.put(StreamsConfig.NUM_STANDBY_REPLICAS_CONFIG, standbyReplicas);
        streams.put(StreamsConfig.REPLICATION_FACTOR_CONFIG, (int) replicationFactor);
        streams.put(StreamsConfig.DESERIALIZATION_EXCEPTION_HANDLER_CLASS_CONFIG, FailureHandler.class);
        streams.put(StreamsConfig.PROCESSING_EXCEPTION_HANDLER_CLASS_CONFIG, FailureHandler.class);
        streams.put(StreamsConfig.PRODUCTION_EXCEPTION_HANDLER_CLASS_CONFIG, FailureHandler.class);
        streams.put(StreamsConfig.producerPrefix("max.request.size"), Limits.DEAD_LETTER_BYTES);
        streams.put(StreamsConfig.producerPrefix("max.in.flight.requests.per.connection"), IN_FLIGHT);
        streams.put(StreamsConfig.topicPrefix("max.message.bytes"), Limits.MESSAGE_BYTES);
        streams.put(StreamsConfig.consumerPrefix("auto.offset.reset"), "earliest");
        streams.put(StreamsConfig.mainConsumerPrefix("session.timeout.ms"), (int) TAKEN_OVER_AFTER.toMillis());
        streams.put(StreamsConfig.mainConsumerPrefix("max.poll.interval.ms"), (int) REBALANCE_TIMEOUT.toMillis());
        return streams;
    }
}
