package io.furrow.fiware.agent;

import java.time.Clock;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.atomic.AtomicLong;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.NgsiError;
import io.furrow.model.event.FiwareScope;

/** Registers groups and devices, provisioned or by their first measure. */
public final class DeviceRegistry {
    /** The agent's default resource; only its groups apply to measures. */
    static final String RESOURCE = "/iot/json";

    private record Topic(String apikey, String deviceId) {}

    private final Map<ServiceGroup.Key, ServiceGroup> groups = new LinkedHashMap<>();
    /** By scope and id, in the order of registration. */
    private final Map<String, ProvisionedDevice> devices = new LinkedHashMap<>();

    private final Map<Topic, ProvisionedDevice> byTopic = new HashMap<>();
    private final Map<String, ProvisionedDevice> byEntity = new HashMap<>();
    private final AtomicLong revision;
    private final Clock clock;
    private int numbered;

    /** @param revision incremented with every change */
    public DeviceRegistry(AtomicLong revision, Clock clock) {
        this.revision = revision;
        this.clock = clock;
    }

    public synchronized void add(ServiceGroup group) throws NgsiError {
        if (groups.containsKey(group.key())) {
            throw AgentErrors.duplicateGroup(group);
        }
        groups.put(group.key(), group.registered(++numbered, clock.millis()));
        revision.incrementAndGet();
    }

    synchronized void change(ServiceGroup.Key key, FiwareScope scope, ObjectNode members) throws NgsiError {
        groups.put(key, require(key, scope).changed(members));
        revision.incrementAndGet();
    }

    synchronized void removeGroup(ServiceGroup.Key key, FiwareScope scope) throws NgsiError {
        groups.remove(require(key, scope).key());
        revision.incrementAndGet();
    }

    private ServiceGroup require(ServiceGroup.Key key, FiwareScope scope) throws NgsiError {
        ServiceGroup group = groups.get(key);
        if (group == null || !group.scope().equals(scope)) {
            throw AgentErrors.noGroup(key.resource(), key.apikey());
        }
        return group;
    }

    public synchronized List<ServiceGroup> groups() {
        return List.copyOf(groups.values());
    }

    synchronized List<ServiceGroup> groups(FiwareScope scope) {
        return groups.values().stream()
                .filter(group -> group.scope().equals(scope))
                .toList();
    }

    /** The group of a device by API key or, without one, by entity type. */
    synchronized Optional<ServiceGroup> groupFor(FiwareScope scope, String apikey, String entityType) {
        return groups.values().stream()
                .filter(group -> group.scope().equals(scope))
                .filter(group -> apikey.isEmpty() || group.apikey().equals(apikey))
                .filter(group -> !apikey.isEmpty()
                        || entityType.isEmpty()
                        || group.entityType().equals(entityType))
                .findFirst();
    }

    public synchronized void add(ProvisionedDevice device) throws NgsiError {
        if (devices.containsKey(device.scope().identity(device.id()))) {
            throw AgentErrors.duplicateDevice(device);
        }
        devices.put(device.scope().identity(device.id()), device);
        byTopic.put(new Topic(device.apikey(), device.id()), device);
        byEntity.put(device.scope().identity(device.entityId()), device);
        revision.incrementAndGet();
    }

    synchronized void remove(FiwareScope scope, String id) throws NgsiError {
        ProvisionedDevice device = device(scope, id).orElseThrow(() -> AgentErrors.noDevice(id, scope));
        devices.remove(scope.identity(id));
        byTopic.remove(new Topic(device.apikey(), id));
        byEntity.remove(scope.identity(device.entityId()));
        revision.incrementAndGet();
    }

    synchronized Optional<ProvisionedDevice> device(FiwareScope scope, String id) {
        return Optional.ofNullable(devices.get(scope.identity(id)));
    }

    public synchronized List<ProvisionedDevice> devices() {
        return List.copyOf(devices.values());
    }

    synchronized List<ProvisionedDevice> devices(FiwareScope scope) {
        return devices.values().stream()
                .filter(device -> device.scope().equals(scope))
                .toList();
    }

    /** The device of a topic; a new one is registered if the group of its API key allows it. */
    synchronized Optional<ProvisionedDevice> behind(String apikey, String deviceId) throws NgsiError {
        ServiceGroup group = groups.get(new ServiceGroup.Key(RESOURCE, apikey));
        if (group == null) {
            return Optional.empty();
        }
        ProvisionedDevice existing = byTopic.get(new Topic(apikey, deviceId));
        if (existing != null || !group.takesUnprovisioned()) {
            return Optional.ofNullable(existing);
        }
        ProvisionedDevice device = ProvisionedDevice.unprovisioned(group, deviceId);
        add(device);
        return Optional.of(device);
    }

    synchronized Optional<ProvisionedDevice> ofEntity(FiwareScope scope, String entityId) {
        return Optional.ofNullable(byEntity.get(scope.identity(entityId)));
    }
}
