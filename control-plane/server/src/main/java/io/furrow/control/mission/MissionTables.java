package io.furrow.control.mission;

import io.furrow.control.manager.Table;
import io.furrow.model.control.MissionTemplate;

/**
 * All that the manager of missions remembers.
 *
 * @param missions by name
 * @param statuses by the same names
 * @param lists records of {@code service.missions.devices} by their keys
 * @param pending by the names of missions
 * @param devices by the key of {@code service.devices}
 * @param templates by {@code <name>@<version>}
 * @param versions by the name of the template
 */
record MissionTables(
        Table<Mission> missions,
        Table<MissionStatus> statuses,
        Table<byte[]> lists,
        Table<PendingAssignment> pending,
        Table<DeviceState> devices,
        Table<MissionTemplate> templates,
        Table<TemplateStore.Versions> versions) {}
