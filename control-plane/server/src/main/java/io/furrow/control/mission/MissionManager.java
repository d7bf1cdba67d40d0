package io.furrow.control.mission;

import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.function.Function;
import java.util.stream.Stream;

import io.furrow.control.domain.Domain;
import io.furrow.control.domain.DomainManager;
import io.furrow.control.health.DeviceHealth;
import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.manager.Observer;
import io.furrow.control.manager.Table;
import io.furrow.control.manager.UnitOfWork;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Processes requests on {@code service.missionmanager}, maintains {@code service.missions}, {@code .missions.status},
 * {@code .templates} and {@code .devices}, and reads {@code service.devices.status}, {@code .health} and
 * {@code .connection}.
 */
public final class MissionManager {
    private static final String MISSIONS = "missions";
    private static final String STATUSES = "mission-statuses";
    private static final String DEVICES = "devices";
    private static final String LISTS = "mission-device-lists";
    private static final String ROLLOUTS = "mission-rollouts";
    private static final String TEMPLATES = "templates";
    private static final String VERSIONS = "template-versions";

    private MissionManager() {}

    /** Names of its stores; users of {@link #handler} need them and those of {@link DomainManager}. */
    public static List<String> stores() {
        return List.of(MISSIONS, STATUSES, LISTS, ROLLOUTS, DEVICES, TEMPLATES, VERSIONS);
    }

    /** Creates a handler on the stores of a processor. */
    public static MissionCommandHandler handler(UnitOfWork unitOfWork, MissionSettings options) {
        Table<Domain> domains = DomainManager.domains(unitOfWork);
        MissionTables tables = new MissionTables(
                unitOfWork.table(MISSIONS, Mission.class),
                unitOfWork.table(STATUSES, MissionStatus.class),
                unitOfWork.table(LISTS),
                unitOfWork.table(ROLLOUTS, PendingAssignment.class),
                unitOfWork.table(DEVICES, DeviceState.class),
                unitOfWork.table(TEMPLATES, MissionTemplate::toBytes, MissionManager::template),
                unitOfWork.table(VERSIONS, TemplateStore.Versions.class));
        SharedStores farm = new SharedStores(
                domains::contains, DomainManager.sequence(unitOfWork), DomainManager.quota(unitOfWork));
        return new MissionCommandHandler(tables, farm, options, unitOfWork);
    }

    /** Adds the manager; its stores and those of domains must exist already. */
    public static void add(ManagerTopology topology, MissionSettings options) {
        List<String> stores = Stream.concat(DomainManager.stores().stream(), stores().stream())
                .toList();
        topology.addManager(ManagerTopic.MISSION, unitOfWork -> handler(unitOfWork, options), stores);

        topology.addStatuses(
                Topics.DEVICES_STATUS,
                "device-statuses",
                "progress-out",
                reports(options, (missions, key, value, now) -> missions.reported(key, DeviceStatus.read(value), now)),
                stores);

        topology.addStatuses(
                Topics.DEVICES_HEALTH,
                "device-healths",
                "first-reports-out",
                reports(
                        options,
                        (missions, key, value, now) ->
                                missions.reported(key, StateJson.readRecord(value, DeviceHealth.class), now)),
                stores);

        topology.addStatuses(
                Topics.DEVICES_CONNECTION,
                "device-connections",
                "silences-out",
                reports(
                        options,
                        (missions, key, value, now) -> missions.reported(key, DeviceConnection.read(value), now)),
                stores);
    }

    private static Function<UnitOfWork, Observer.OfStatuses> reports(MissionSettings options, Report report) {
        return unitOfWork -> {
            MissionCommandHandler missions = handler(unitOfWork, options);
            return (key, value, now) -> report.take(missions, key, value, now);
        };
    }

    /** Passes a record to the handler. */
    private interface Report {
        void take(MissionCommandHandler missions, String key, byte[] value, long now) throws UnreadableException;
    }

    private static MissionTemplate template(byte[] value) {
        try {
            return MissionTemplate.read(value);
        } catch (RejectedException e) {
            throw new IllegalStateException(
                    "a stored template cannot be read: " + new String(value, StandardCharsets.UTF_8), e);
        }
    }
}
