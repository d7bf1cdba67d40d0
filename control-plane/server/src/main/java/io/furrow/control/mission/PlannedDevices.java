package io.furrow.control.mission;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.DeviceGroup;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.GroupRef;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Expands the groups of a mission to single devices, deterministically. The n-th device of a type is
 * {@code urn:ngsi-ld:<type>:<mission>-<n>} unless its group has an id. The id at the IoT Agent is that of the entity,
 * with {@code +}, which MQTT topics do not allow, replaced by {@code %2B}.
 */
final class PlannedDevices {
    private final Mission mission;
    private final FiwareScope scope;
    private final boolean simulatedByDefault;
    private final long from;
    private final Map<String, Integer> numbers = new HashMap<>();
    private final Map<String, List<String>> idsByLabel = new HashMap<>();
    private final List<DesiredDevice> devices = new ArrayList<>();

    private PlannedDevices(Mission mission, MissionSettings options, long from) {
        this.mission = mission;
        this.scope = options.scope();
        this.simulatedByDefault = options.simulatedByDefault();
        this.from = from;
    }

    /** Returns all devices, desired from a time on, with sequence 0. */
    static List<DesiredDevice> of(Mission mission, List<ListedGroup> groups, MissionSettings options, long from) {
        PlannedDevices planned = new PlannedDevices(mission, options, from);
        List<List<String>> ids =
                groups.stream().map(each -> planned.name(each.group())).toList();
        for (int i = 0; i < groups.size(); i++) {
            planned.add(groups.get(i), ids.get(i));
        }
        return planned.devices;
    }

    private List<String> name(DeviceGroup group) {
        List<String> ids = new ArrayList<>();
        for (int i = 0; i < group.count(); i++) {
            ids.add(group.id() != null ? group.id() : "urn:ngsi-ld:%s:%s".formatted(group.type(), numbered(group)));
        }
        if (group.label() != null) {
            idsByLabel.put(group.label(), ids);
        }
        return ids;
    }

    private String numbered(DeviceGroup group) {
        return mission.mission() + "-" + numbers.merge(group.type(), 1, Integer::sum);
    }

    private boolean isSimulated(DeviceGroup group) {
        boolean simulated = group.simulated() == null ? simulatedByDefault : group.simulated();
        return simulated && group.type() != null;
    }

    private void add(ListedGroup listed, List<String> ids) {
        DeviceGroup group = listed.group();
        GroupRef ref = group.settings().isEmpty() ? null : listed.ref();
        List<String> carriers = group.carriedBy() == null ? List.of() : idsByLabel.get(group.carriedBy());
        for (int i = 0; i < ids.size(); i++) {
            String carrier = carriers.isEmpty() ? null : carriers.get(i % carriers.size());
            DeviceVersion version = new DeviceVersion(
                    ids.get(i),
                    scope.service(),
                    scope.servicePath(),
                    mission.domain(),
                    mission.mission(),
                    from,
                    null,
                    0,
                    carrier,
                    group.settings().has("at"));
            String device = group.type() != null ? ids.get(i).replace("+", "%2B") : null;
            ObjectNode noSettings = NgsiJson.object();
            devices.add(new DesiredDevice(
                    version,
                    group.type(),
                    device,
                    true,
                    group.period(),
                    isSimulated(group),
                    noSettings,
                    ref == null ? null : ref.ofMember(i),
                    0));
        }
    }
}
