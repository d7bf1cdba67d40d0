package io.furrow.simulators.fiware;

import java.time.Clock;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;

/** The groups and devices that are provisioned, and those that registered themselves with a first measure. */
final class DeviceRegistry {
    /** The agent's default resource: only groups of it are found for what devices send. */
    static final String RESOURCE = "/iot/json";

    private record Topic(String apikey, String deviceId) {}

    private final Map<ServiceGroup.Key, ServiceGroup> groups = new LinkedHashMap<>();
    /** By scope and id, in the order of their coming. */
    private final Map<String, Device> devices = new LinkedHashMap<>();

    private final Map<Topic, Device> byTopic = new HashMap<>();
    private final Map<String, Device> byEntity = new HashMap<>();
    private final Revision revision;
    private final Clock clock;
    private int numbered;

    /** @param revision advanced by every change */
    DeviceRegistry(Revision revision, Clock clock) {
        this.revision = revision;
        this.clock = clock;
    }

    synchronized void add(ServiceGroup group) throws NgsiError {
        if (groups.containsKey(group.key())) {
            throw AgentErrors.duplicateGroup(group);
        }
        groups.put(group.key(), group.registered(++numbered, clock.millis()));
        revision.advance();
    }

    synchronized void change(ServiceGroup.Key key, FiwareScope scope, ObjectNode members) throws NgsiError {
        groups.put(key, require(key, scope).changed(members));
        revision.advance();
    }

    synchronized void removeGroup(ServiceGroup.Key key, FiwareScope scope) throws NgsiError {
        groups.remove(require(key, scope).key());
        revision.advance();
    }

    private ServiceGroup require(ServiceGroup.Key key, FiwareScope scope) throws NgsiError {
        ServiceGroup group = groups.get(key);
        if (group == null || !group.scope().equals(scope)) {
            throw AgentErrors.noGroup(key.resource(), key.apikey());
        }
        return group;
    }

    synchronized List<ServiceGroup> groups() {
        return List.copyOf(groups.values());
    }

    synchronized List<ServiceGroup> groups(FiwareScope scope) {
        return groups.values().stream()
                .filter(group -> group.scope().equals(scope))
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
        if (devices.containsKey(device.scope().identity(device.id()))) {
            throw AgentErrors.duplicateDevice(device);
        }
        put(device);
    }

    /** Another description of a device. */
    synchronized void replace(Device before, Device after) throws NgsiError {
        remove(before.scope(), before.id());
        put(after);
    }

    private void put(Device device) {
        devices.put(device.scope().identity(device.id()), device);
        byTopic.put(new Topic(device.apikey(), device.id()), device);
        byEntity.put(device.scope().identity(device.entityId()), device);
        revision.advance();
    }

    synchronized void remove(FiwareScope scope, String id) throws NgsiError {
        Device device = device(scope, id).orElseThrow(() -> AgentErrors.noDevice(id, scope));
        devices.remove(scope.identity(id));
        byTopic.remove(new Topic(device.apikey(), id));
        byEntity.remove(scope.identity(device.entityId()));
        revision.advance();
    }

    synchronized Optional<Device> device(FiwareScope scope, String id) {
        return Optional.ofNullable(devices.get(scope.identity(id)));
    }

    synchronized List<Device> devices() {
        return List.copyOf(devices.values());
    }

    synchronized List<Device> devices(String service, PathFilter paths) {
        return devices.values().stream()
                .filter(device -> device.scope().service().equals(service)
                        && paths.matches(device.scope().servicePath()))
                .toList();
    }

    synchronized List<Device> devices(FiwareScope scope) {
        return devices.values().stream()
                .filter(device -> device.scope().equals(scope))
                .toList();
    }

    /** The device behind a topic; one that is new registers itself when the group of its API key lets it. */
    synchronized Optional<Device> behind(String apikey, String deviceId) throws NgsiError {
        ServiceGroup group = groups.get(new ServiceGroup.Key(RESOURCE, apikey));
        if (group == null) {
            return Optional.empty();
        }
        Device known = byTopic.get(new Topic(apikey, deviceId));
        if (known != null || !group.takesUnprovisioned()) {
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
