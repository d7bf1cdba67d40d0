package io.furrow.control.mission;

import io.furrow.control.manager.Table;
import io.furrow.model.control.MissionTemplate;

/**
 * The stores of the mission manager.
 *
 * @param missions by name
 * @param statuses by name of the mission
 * @param lists records of {@code service.missions.devices} by their keys
 * @param pending by name of the mission
 * @param devices by the key of {@code service.devices}
 * @param templates by {@code <name>@<version>}
 * @param versions by name of the template
 */
record MissionTables(
        Table<Mission> missions,
        Table<MissionStatus> statuses,
        Table<byte[]> lists,
        Table<PendingAssignment> pending,
        Table<DeviceState> devices,
        Table<MissionTemplate> templates,
        Table<TemplateStore.Versions> versions) {}
