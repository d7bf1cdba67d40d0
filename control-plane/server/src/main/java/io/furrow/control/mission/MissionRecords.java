package io.furrow.control.mission;

import io.furrow.control.manager.Records;
import io.furrow.model.control.MissionTemplate;

/**
 * All that the manager of missions remembers.
 *
 * @param missions by name
 * @param statuses by the same names
 * @param lists records of {@code service.missions.devices} by their keys
 * @param rollouts by the names of missions
 * @param devices by the key of {@code service.devices}
 * @param templates by {@code <name>@<version>}
 * @param versions by the name of the template
 */
record MissionRecords(
        Records<Mission> missions,
        Records<MissionStatus> statuses,
        Records<byte[]> lists,
        Records<Rollout> rollouts,
        Records<DeviceState> devices,
        Records<MissionTemplate> templates,
        Records<TemplateStore.Versions> versions) {}
