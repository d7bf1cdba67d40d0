package io.furrow.control.replay;

import java.util.List;
import java.util.UUID;
import java.util.function.Supplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.manager.Table;
import io.furrow.control.manager.UnitOfWork;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Processes requests on {@code service.replaymanager}, maintains {@code service.replays}, and reads
 * {@code service.replays.status} and {@code service.recordings}.
 */
public final class ReplayManager {
    private static final String REPLAYS = "replays";
    private static final String REPORTS = "replay-reports";
    private static final String SEQUENCE = "replay-sequence";
    private static final String RECORDINGS = "recordings";

    private static final Logger LOG = LoggerFactory.getLogger(ReplayManager.class);

    private ReplayManager() {}

    /** @param ids of new replays */
    public static void add(ManagerTopology topology, Supplier<UUID> ids, ReplaySettings settings) {
        List<String> stores = List.of(REPLAYS, REPORTS, SEQUENCE);
        topology.addGlobalStore(RECORDINGS, Topics.RECORDINGS);
        topology.addStores(stores);
        topology.addManager(ManagerTopic.REPLAY, unitOfWork -> handler(unitOfWork, ids, settings), stores);
        topology.addStatuses(
                Topics.REPLAYS_STATUS,
                "replay-statuses",
                "ended-replays-out",
                unitOfWork -> {
                    ReplayCommandHandler handler = handler(unitOfWork, ids, settings);
                    return (key, value, now) -> handler.reported(key, ReplayStatus.read(value), now);
                },
                stores);
    }

    /** Returns null if the record cannot be read. */
    private static RecordedMission listed(byte[] value) {
        try {
            return RecordedMission.read(value);
        } catch (UnreadableException e) {
            LOG.debug("a record of {} cannot be read", Topics.RECORDINGS, e);
            return null;
        }
    }

    private static DesiredReplay stored(byte[] value) {
        return NgsiJson.own(() -> DesiredReplay.read(value));
    }

    private static ReplayCommandHandler handler(UnitOfWork unitOfWork, Supplier<UUID> ids, ReplaySettings settings) {
        Table<RecordedMission> recordings =
                unitOfWork.table(RECORDINGS, RecordedMission::toBytes, ReplayManager::listed);
        ReplayCommandHandler.ReplayStores stores = new ReplayCommandHandler.ReplayStores(
                unitOfWork.table(REPLAYS, DesiredReplay::toBytes, ReplayManager::stored),
                unitOfWork.table(REPORTS, ReportedReplay.class),
                unitOfWork.table(SEQUENCE, Long.class));
        return new ReplayCommandHandler(
                stores, new RecordedMissions(settings.hasRecordings(), recordings::get), ids, settings, unitOfWork);
    }
}
