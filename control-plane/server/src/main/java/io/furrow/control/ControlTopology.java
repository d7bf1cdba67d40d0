package io.furrow.control;

import java.time.Duration;
import java.util.UUID;

import org.apache.kafka.streams.Topology;

import io.furrow.control.domain.DomainManager;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.mission.MissionManager;
import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplayManager;
import io.furrow.control.replay.ReplaySettings;

/** Builds the topology of the three managers. */
final class ControlTopology {
    private ControlTopology() {}

    /**
     * @param requestRetention how long ids of requests are stored for deduplication
     * @param replays settings of replays
     */
    static Topology of(Duration requestRetention, MissionSettings missions, ReplaySettings replays) {
        ManagerTopology topology = new ManagerTopology(requestRetention);
        topology.addStores(DomainManager.stores());
        topology.addStores(MissionManager.stores());

        DomainManager.add(
                topology, unitOfWork -> MissionManager.handler(unitOfWork, missions), MissionManager.stores());

        MissionManager.add(topology, missions);

        ReplayManager.add(topology, UUID::randomUUID, replays);

        return topology.build();
    }
}
