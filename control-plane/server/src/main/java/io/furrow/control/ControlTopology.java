package io.furrow.control;

import java.time.Duration;
import java.util.List;
import java.util.UUID;

import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.Topology;

import io.furrow.control.domain.DomainManager;
import io.furrow.control.manager.StoreTable;
import io.furrow.control.mission.MissionManager;
import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplayManager;
import io.furrow.control.replay.ReplaySettings;

/** The three managers as one topology of Kafka Streams. */
final class ControlTopology {
    private ControlTopology() {}

    /**
     * @param remembered how long ids of requests are
     * @param replays how they are managed
     */
    static Topology of(Duration remembered, MissionSettings missions, ReplaySettings replays) {
        StreamsBuilder builder = new StreamsBuilder();

        for (List<String> shared : List.of(DomainManager.stores(), MissionManager.stores())) {
            shared.forEach(store -> builder.addStateStore(StoreTable.builder(store)));
        }

        DomainManager.add(
                builder,
                remembered,
                (context, publisher) -> MissionManager.handler(context, publisher, missions),
                MissionManager.stores());

        MissionManager.add(builder, remembered, missions);

        ReplayManager.add(builder, remembered, UUID::randomUUID, replays);

        return builder.build();
    }
}
