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
 * The groups and devices that the IoT Agent has in one scope: read once, then updated with what is changed. Changes only what was made
 * with one of our API keys; what others have provisioned stays.
 */
final class AgentRegistrationCache {
    private final AgentClient agent;
    private final FiwareScope scope;
    private final AgentRegistrationFactory registrations;
    private final RemovalGuard removals;
    private final Map<String, AgentRegistration> devices = new HashMap<>();
    /** Resource and API key of each group. */
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

    /** Reads what the agent has. */
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

    /** Whether the agent knows a device as it is desired, and finds it by its group. */
    boolean has(AgentRegistration device) {
        return device.equals(devices.get(device.device())) && groups.contains(GroupKey.of(agent.groupOf(device)));
    }

    /**
     * Makes devices known, as far as the budget goes, and first the groups they need.
     *
     * @return why the agent did not take those that it refused; of the others {@link #has} says which it has now
     */
    Map<AgentRegistration, String> add(List<AgentRegistration> batch, TimeBudget budget)
            throws IOException, InterruptedException {
        Map<AgentRegistration, String> refused = new LinkedHashMap<>();
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
                refused.put(device, e.getMessage());
            }
        }
        if (missing.isEmpty()) {
            return refused;
        }
        try {
            agent.add(scope, missing);
            missing.forEach(device -> devices.put(device.device(), device));
        } catch (RejectedByAgentException | AgentFaultException e) {
            // One of them is the cause; the others shall not wait for it.
            addSingly(missing, budget, refused);
        }
        return refused;
    }

    /** Adds what the agent has not made of a batch; it is unavailable if it fails on every device. */
    private void addSingly(List<AgentRegistration> batch, TimeBudget budget, Map<AgentRegistration, String> refused)
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
                    refused.put(device, e.getMessage());
                    answered++;
                } catch (AgentFaultException e) {
                    faults.put(device, e);
                }
            }
        }
        if (answered == 0 && !faults.isEmpty()) {
            throw faults.values().iterator().next();
        }
        faults.forEach((device, fault) -> refused.put(device, fault.getMessage()));
    }

    /** The agent may still have been making it when it answered for the batch. */
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

    /** Sees to it that nothing stands in the way of a device, and that its group is there. */
    private void prepare(AgentRegistration device) throws IOException, RejectedByAgentException, InterruptedException {
        AgentRegistration there = devices.get(device.device());
        if (there != null && !registrations.isOurs(there.apiKey(), there.mission())) {
            throw new RejectedByAgentException(
                    "somebody else has provisioned a device '%s' at the IoT Agent; remove it there, or give this one another id"
                            .formatted(device.device()));
        }
        if (there != null && !there.mission().equals(device.mission()) && !removals.allows(there)) {
            throw new RejectedByAgentException(
                    "the IoT Agent has '%s' as a device of mission '%s', of which this Kafka knows nothing; check --kafka, give this one another id, or move it by a start with --forget-devices"
                            .formatted(device.device(), there.mission()));
        }
        Group group = agent.groupOf(device);
        if (!groups.contains(GroupKey.of(group))) {
            add(group);
        }
        if (there != null && !there.equals(device)) {
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
     * Removes, as far as the budget goes, our devices that are not desired, and our groups that no device needs.
     *
     * @return why the agent did not remove one, null if it did; the others are removed
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
        for (Group group : unneeded(apiKeys)) {
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

    /** Whether all of ours that is here is desired. */
    boolean isClean(Set<String> desired, Set<String> apiKeys) {
        return leftovers(desired).isEmpty() && unneeded(apiKeys).isEmpty();
    }

    private List<AgentRegistration> leftovers(Set<String> desired) {
        return own().filter(device -> !desired.contains(device.device()))
                .filter(removals::allows)
                .toList();
    }

    private Stream<AgentRegistration> own() {
        return devices.values().stream().filter(device -> registrations.isOurs(device.apiKey(), device.mission()));
    }

    /** Groups of missions that have no devices, and of a resource that was set before. */
    private List<Group> unneeded(Set<String> apiKeys) {
        return undesiredGroups(apiKeys).filter(this::mayBeRemoved).toList();
    }

    private Stream<Group> undesiredGroups(Set<String> apiKeys) {
        return ownGroups.values().stream()
                .filter(group -> !apiKeys.contains(group.apiKey()) || !agent.isOfItsResource(group));
    }

    private boolean mayBeRemoved(Group group) {
        return removals.allows(group)
                && retainedDevices().noneMatch(device -> device.apiKey().equals(group.apiKey()));
    }

    /** What is desired may be removed, to be made again otherwise. */
    private Stream<AgentRegistration> retainedDevices() {
        return own().filter(device -> !removals.allows(device));
    }

    /** What stays of ours though this Kafka does not want it, or wants it in another mission. */
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
