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
 * Settings of the control plane.
 *
 * @param client settings of Kafka clients, including {@code bootstrap.servers}
 * @param standbyReplicas number of further instances with a copy of all state, ready to take over; 0 with a single
 *     instance
 * @param replicationFactor of the topics that it creates; -1 for the broker's default
 * @param requestRetention how long ids of requests are stored for deduplication
 * @param missions settings of missions
 * @param replays settings of replays
 */
public record ControlSettings(
        Properties client,
        int standbyReplicas,
        short replicationFactor,
        Duration requestRetention,
        MissionSettings missions,
        ReplaySettings replays) {
    /** Name of the consumer group and prefix of its internal topics, from which state is rebuilt: never changed. */
    static final String APPLICATION = "furrow-control-plane";

    /** Maximum time that a rebalance waits for a member; requests are not answered meanwhile. The default is five minutes. */
    private static final Duration REBALANCE_TIMEOUT = Duration.ofSeconds(60);

    private static final Duration TAKEN_OVER_AFTER = Duration.ofSeconds(10);

    /**
     * The broker may reject the first batch of a transaction while it still writes the markers of the previous one. A
     * second batch in flight would then arrive out of order, which broker and client log as an error before they retry.
     */
    private static final int IN_FLIGHT = 1;

    /** Returns settings for a single instance: request ids are stored for an hour, devices have a minute to come up. */
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
        return new ControlSettings(client, standbyReplicas, replicationFactor, requestRetention, newMissions, replays);
    }

    public ControlSettings withStandbyReplicas(int replicas) {
        return new ControlSettings(client, replicas, replicationFactor, requestRetention, missions, replays);
    }

    public ControlSettings withReplicationFactor(short factor) {
        return new ControlSettings(client, standbyReplicas, factor, requestRetention, missions, replays);
    }

    public ControlSettings with(ReplaySettings newReplays) {
        return new ControlSettings(client, standbyReplicas, replicationFactor, requestRetention, missions, newReplays);
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
