package io.furrow.provisioner;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

import io.furrow.model.event.FiwareScope;
import io.furrow.provisioner.AgentClient.Group;
import io.furrow.provisioner.RemovalGuard.Retained;

/**
 * Caches the service groups and devices of the IoT Agent in one scope: reads them once, then tracks its own changes. It
 * changes only groups and devices with an API key of this farm; those that others have provisioned stay.
 */
final class AgentRegistrationCache {
    private final AgentClient agent;
    private final FiwareScope scope;
    private final AgentRegistrationFactory registrations;
    private final RemovalGuard removals;
    private final Map<String, AgentRegistration> devices = new HashMap<>();
    /** Keys of all groups, including those of others. */
    private final Set<GroupKey> groups = new HashSet<>();

    private final Map<GroupKey, Group> ownGroups = new LinkedHashMap<>();

    private record GroupKey(String resource, String apiKey) {
        static GroupKey of(Group group) {
            return new GroupKey(group.resource(), group.apiKey());
        }
    }

    private AgentRegistrationCache(
            AgentClient agent, FiwareScope scope, AgentRegistrationFactory registrations, RemovalGuard removals) {
        this.agent = agent;
        this.scope = scope;
        this.registrations = registrations;
        this.removals = removals;
    }

    static AgentRegistrationCache read(
            AgentClient agent, FiwareScope scope, AgentRegistrationFactory registrations, RemovalGuard removals)
            throws IOException, RejectedByAgentException, InterruptedException {
        AgentRegistrationCache registry = new AgentRegistrationCache(agent, scope, registrations, removals);
        registry.readDevices();
        registry.readGroups();
        return registry;
    }

    private void readDevices() throws IOException, RejectedByAgentException, InterruptedException {
        List<AgentRegistration> all = agent.devices(scope);
        devices.clear();
        all.forEach(device -> devices.put(device.device(), device));
    }

    private void readGroups() throws IOException, RejectedByAgentException, InterruptedException {
        List<Group> all = agent.groups(scope);
        groups.clear();
        ownGroups.clear();
        for (Group group : all) {
            groups.add(GroupKey.of(group));
            if (registrations.isOurs(group.apiKey(), group.mission())) {
                ownGroups.put(GroupKey.of(group), group);
            }
        }
    }

    /** Whether the agent has the device as desired, and the service group by which it finds the device. */
    boolean has(AgentRegistration device) {
        return device.equals(devices.get(device.device())) && groups.contains(GroupKey.of(agent.groupOf(device)));
    }

    /**
     * Creates devices, and first the groups that they need, until the time budget is spent.
     *
     * @return the reason for each rejected device; for the others {@link #has} tells whether they exist now
     */
    Map<AgentRegistration, String> add(List<AgentRegistration> batch, TimeBudget budget)
            throws IOException, InterruptedException {
        Map<AgentRegistration, String> rejected = new LinkedHashMap<>();
        List<AgentRegistration> missing = new ArrayList<>();
        for (AgentRegistration device : batch) {
            if (budget.isSpent()) {
                break;
            }
            try {
                prepare(device);
                if (!has(device)) {
                    missing.add(device);
                }
            } catch (RejectedByAgentException e) {
                rejected.put(device, e.getMessage());
            }
        }
        if (missing.isEmpty()) {
            return rejected;
        }
        try {
            agent.add(scope, missing);
            missing.forEach(device -> devices.put(device.device(), device));
        } catch (RejectedByAgentException | AgentFaultException e) {
            // One device may be the cause; it must not block the others.
            addSingly(missing, budget, rejected);
        }
        return rejected;
    }

    /** Adds the missing devices of a batch one by one; the agent counts as unavailable if it fails for every device. */
    private void addSingly(List<AgentRegistration> batch, TimeBudget budget, Map<AgentRegistration, String> rejected)
            throws IOException, InterruptedException {
        try {
            readDevices();
        } catch (RejectedByAgentException e) {
            throw new IOException(e.getMessage(), e);
        }
        Map<AgentRegistration, AgentFaultException> faults = new LinkedHashMap<>();
        int answered = 0;
        for (AgentRegistration device : batch) {
            if (has(device)) {
                answered++;
            } else if (!budget.isSpent()) {
                try {
                    addOne(device);
                    answered++;
                } catch (RejectedByAgentException e) {
                    rejected.put(device, e.getMessage());
                    answered++;
                } catch (AgentFaultException e) {
                    faults.put(device, e);
                }
            }
        }
        if (answered == 0 && !faults.isEmpty()) {
            throw faults.values().iterator().next();
        }
        faults.forEach((device, fault) -> rejected.put(device, fault.getMessage()));
    }

    /** A rejection is ignored if the device exists now: the agent may still have been creating it after it responded to the batch. */
    private void addOne(AgentRegistration device) throws IOException, RejectedByAgentException, InterruptedException {
        try {
            agent.add(scope, List.of(device));
        } catch (RejectedByAgentException e) {
            if (!agent.device(scope, device.device()).filter(device::equals).isPresent()) {
                throw e;
            }
        }
        devices.put(device.device(), device);
    }

    /** Creates the group of a device and removes an outdated registration of the device. */
    private void prepare(AgentRegistration device) throws IOException, RejectedByAgentException, InterruptedException {
        AgentRegistration existing = devices.get(device.device());
        if (existing != null && !registrations.isOurs(existing.apiKey(), existing.mission())) {
            throw new RejectedByAgentException(
                    "somebody else has provisioned a device '%s' at the IoT Agent; remove it there, or give this one another id"
                            .formatted(device.device()));
        }
        if (existing != null && !existing.mission().equals(device.mission()) && !removals.allows(existing)) {
            throw new RejectedByAgentException(
                    "the IoT Agent has '%s' as a device of mission '%s', of which this Kafka knows nothing; check --kafka, give this one another id, or move it by a start with --forget-devices"
                            .formatted(device.device(), existing.mission()));
        }
        Group group = agent.groupOf(device);
        if (!groups.contains(GroupKey.of(group))) {
            add(group);
        }
        if (existing != null && !existing.equals(device)) {
            agent.removeDevice(scope, device.device());
            devices.remove(device.device());
        }
    }

    private void add(Group group) throws IOException, RejectedByAgentException, InterruptedException {
        if (agent.add(scope, group)) {
            groups.add(GroupKey.of(group));
            ownGroups.put(GroupKey.of(group), group);
            return;
        }
        readGroups();
        if (!groups.contains(GroupKey.of(group))) {
            throw new RejectedByAgentException(
                    "the IoT Agent has a service group with the API key of mission '%s' and resource '%s' in another service or service path; remove it there"
                            .formatted(group.mission(), group.resource()));
        }
    }

    /**
     * Removes own devices that are not desired and own groups that no device needs, until the time budget is spent.
     *
     * @return the reason of the last failed removal; null if none failed
     */
    String remove(Set<String> desired, Set<String> apiKeys, TimeBudget budget)
            throws IOException, InterruptedException {
        String failure = null;
        for (AgentRegistration device : leftovers(desired)) {
            if (budget.isSpent()) {
                return failure;
            }
            try {
                agent.removeDevice(scope, device.device());
                devices.remove(device.device());
            } catch (RejectedByAgentException | AgentFaultException e) {
                failure = e.getMessage();
            }
        }
        for (Group group : unneededGroups(apiKeys)) {
            boolean empty =
                    leftovers(desired).stream().noneMatch(left -> left.apiKey().equals(group.apiKey()));
            if (empty && !budget.isSpent()) {
                try {
                    agent.remove(scope, group);
                    groups.remove(GroupKey.of(group));
                    ownGroups.remove(GroupKey.of(group));
                } catch (RejectedByAgentException | AgentFaultException e) {
                    failure = e.getMessage();
                }
            }
        }
        return failure;
    }

    /** Whether there are no own devices or groups to remove. */
    boolean isClean(Set<String> desired, Set<String> apiKeys) {
        return leftovers(desired).isEmpty() && unneededGroups(apiKeys).isEmpty();
    }

    private List<AgentRegistration> leftovers(Set<String> desired) {
        return own().filter(device -> !desired.contains(device.device()))
                .filter(removals::allows)
                .toList();
    }

    private Stream<AgentRegistration> own() {
        return devices.values().stream().filter(device -> registrations.isOurs(device.apiKey(), device.mission()));
    }

    /** Returns removable groups of missions without devices, and those of another resource than the configured one. */
    private List<Group> unneededGroups(Set<String> apiKeys) {
        return undesiredGroups(apiKeys).filter(this::mayBeRemoved).toList();
    }

    private Stream<Group> undesiredGroups(Set<String> apiKeys) {
        return ownGroups.values().stream()
                .filter(group -> !apiKeys.contains(group.apiKey()) || !agent.hasOwnResource(group));
    }

    private boolean mayBeRemoved(Group group) {
        return removals.allows(group)
                && retainedDevices().noneMatch(device -> device.apiKey().equals(group.apiKey()));
    }

    /** Returns own devices that must not be removed; desired ones may be, because they are created again. */
    private Stream<AgentRegistration> retainedDevices() {
        return own().filter(device -> !removals.allows(device));
    }

    /** Returns own devices and groups that stay although they are not desired in this Kafka, or in another mission. */
    Retained retained(Set<String> apiKeys) {
        return new Retained(
                List.of(),
                retainedDevices().map(AgentRegistration::device).toList(),
                undesiredGroups(apiKeys)
                        .filter(group -> !mayBeRemoved(group))
                        .map(Group::mission)
                        .toList());
    }
}
