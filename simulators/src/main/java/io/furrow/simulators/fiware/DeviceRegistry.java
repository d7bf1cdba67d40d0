package io.furrow.simulators.fiware;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import io.furrow.model.event.FiwareScope;

/** The groups and devices that are provisioned, and those that registered themselves with a first measure. */
final class DeviceRegistry {
    private record Topic(String apikey, String deviceId) {}

    private final Map<String, ServiceGroup> groups = new LinkedHashMap<>();
    /** By scope and id, in the order of their coming. */
    private final Map<String, Device> devices = new LinkedHashMap<>();

    private final Map<Topic, Device> byTopic = new HashMap<>();
    private final Map<String, Device> byEntity = new HashMap<>();
    private final Revision revision;

    /** @param revision advanced by every change */
    DeviceRegistry(Revision revision) {
        this.revision = revision;
    }

    synchronized void add(ServiceGroup group) throws NgsiError {
        if (groups.putIfAbsent(group.apikey(), group) != null) {
            throw new NgsiError(
                    409,
                    "DUPLICATE_GROUP",
                    "A device configuration already exists for resource " + group.resource() + " and API Key "
                            + group.apikey());
        }
        revision.advance();
    }

    synchronized void removeGroup(FiwareScope scope, String apikey) throws NgsiError {
        ServiceGroup group = groups.get(apikey);
        if (group == null || !group.scope().equals(scope)) {
            throw new NgsiError(404, "DEVICE_GROUP_NOT_FOUND", "Couldn't find device group");
        }
        groups.remove(apikey);
        revision.advance();
    }

    synchronized List<ServiceGroup> groups() {
        return List.copyOf(groups.values());
    }

    synchronized List<ServiceGroup> groups(String service, PathFilter paths) {
        return groups.values().stream()
                .filter(group -> group.scope().service().equals(service)
                        && paths.matches(group.scope().servicePath()))
                .toList();
    }

    /** The group that a device with this API key or, where it names none, this entity type belongs to. */
    synchronized Optional<ServiceGroup> groupFor(FiwareScope scope, String apikey, String entityType) {
        return groups.values().stream()
                .filter(group -> group.scope().equals(scope))
                .filter(group -> apikey.isEmpty() || group.apikey().equals(apikey))
                .filter(group -> !apikey.isEmpty()
                        || entityType.isEmpty()
                        || group.entityType().equals(entityType))
                .findFirst();
    }

    synchronized void add(Device device) throws NgsiError {
        if (devices.putIfAbsent(device.scope().identity(device.id()), device) != null) {
            throw new NgsiError(
                    409,
                    "DUPLICATE_DEVICE_ID",
                    "A device with the same pair (Service, DeviceId) was found:" + device.id());
        }
        byTopic.put(new Topic(device.apikey(), device.id()), device);
        byEntity.put(device.scope().identity(device.entityId()), device);
        revision.advance();
    }

    synchronized Device remove(FiwareScope scope, String id) throws NgsiError {
        Device device = require(scope, id);
        devices.remove(scope.identity(id));
        byTopic.remove(new Topic(device.apikey(), id));
        byEntity.remove(scope.identity(device.entityId()));
        revision.advance();
        return device;
    }

    synchronized Device require(FiwareScope scope, String id) throws NgsiError {
        return Optional.ofNullable(devices.get(scope.identity(id)))
                .orElseThrow(() -> new NgsiError(404, "DEVICE_NOT_FOUND", "No device was found with id:" + id));
    }

    synchronized List<Device> devices() {
        return List.copyOf(devices.values());
    }

    synchronized List<Device> devices(FiwareScope scope) {
        return devices.values().stream()
                .filter(device -> device.scope().equals(scope))
                .toList();
    }

    /** The device behind a topic; one that is new registers itself when the group of its API key lets it. */
    synchronized Optional<Device> behind(String apikey, String deviceId) throws NgsiError {
        Device known = byTopic.get(new Topic(apikey, deviceId));
        ServiceGroup group = groups.get(apikey);
        if (known != null || group == null || !group.takesUnprovisioned()) {
            return Optional.ofNullable(known);
        }
        Device device = Device.unprovisioned(group, deviceId);
        add(device);
        return Optional.of(device);
    }

    synchronized Optional<Device> ofEntity(FiwareScope scope, String entityId) {
        return Optional.ofNullable(byEntity.get(scope.identity(entityId)));
    }
}
