package io.furrow.control.provisioning;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import io.furrow.control.provisioning.AgentClient.Group;
import io.furrow.model.event.FiwareScope;

/**
 * What the IoT Agent has in one scope: asked once, then kept in step with what is done. Changes only what was made with one of our
 * API keys; what others have provisioned stays.
 */
final class AgentBook {
    /** As many as a body of at most a megabyte holds, and an agent makes in some seconds. */
    static final int BATCH = 100;

    private final AgentClient agent;
    private final FiwareScope scope;
    private final Registrations registrations;
    private final Map<String, Registration> devices = new HashMap<>();
    private final Set<String> groups = new HashSet<>();
    private final Set<String> ownGroups = new HashSet<>();

    private AgentBook(AgentClient agent, FiwareScope scope, Registrations registrations) {
        this.agent = agent;
        this.scope = scope;
        this.registrations = registrations;
    }

    /** Asks the agent. */
    static AgentBook open(AgentClient agent, FiwareScope scope, Registrations registrations)
            throws IOException, RefusedByAgentException, InterruptedException {
        AgentBook book = new AgentBook(agent, scope, registrations);
        agent.devices(scope).forEach(device -> book.devices.put(device.device(), device));
        for (Group group : agent.groups(scope)) {
            book.groups.add(group.apiKey());
            if (registrations.isOurs(group.apiKey(), group.mission())) {
                book.ownGroups.add(group.apiKey());
            }
        }
        return book;
    }

    boolean has(Registration device) {
        return device.equals(devices.get(device.device()));
    }

    /**
     * Makes a batch of devices known, and first the groups they need.
     *
     * @return why each of those was refused that the agent does not take
     */
    Map<Registration, String> add(List<Registration> batch) throws IOException, InterruptedException {
        Map<Registration, String> refused = new LinkedHashMap<>();
        List<Registration> clear = new ArrayList<>();
        for (Registration device : batch) {
            try {
                prepare(device);
                clear.add(device);
            } catch (RefusedByAgentException e) {
                refused.put(device, e.getMessage());
            }
        }
        if (clear.isEmpty()) {
            return refused;
        }
        try {
            agent.add(scope, clear);
            clear.forEach(device -> devices.put(device.device(), device));
        } catch (RefusedByAgentException e) {
            // One of them is the cause; the others shall not wait for it.
            for (Registration device : clear) {
                addAlone(device, refused);
            }
        }
        return refused;
    }

    private void addAlone(Registration device, Map<Registration, String> refused)
            throws IOException, InterruptedException {
        try {
            agent.add(scope, List.of(device));
            devices.put(device.device(), device);
        } catch (RefusedByAgentException e) {
            refused.put(device, e.getMessage());
        }
    }

    private void prepare(Registration device) throws IOException, RefusedByAgentException, InterruptedException {
        if (!groups.contains(device.apiKey())) {
            agent.add(scope, new Group(device.apiKey(), device.domain(), device.mission()));
            groups.add(device.apiKey());
            ownGroups.add(device.apiKey());
        }
        Registration there = devices.get(device.device());
        if (there == null) {
            return;
        }
        if (!registrations.isOurs(there.apiKey(), there.mission())) {
            throw new RefusedByAgentException(
                    "somebody else has provisioned a device '%s' at the IoT Agent; remove it there, or give this one another id"
                            .formatted(device.device()));
        }
        agent.removeDevice(scope, device.device());
        devices.remove(device.device());
    }

    /** Removes at most a batch of our devices that are not wanted; of a group that nobody needs the group once they are gone. */
    void remove(Set<String> wanted, Set<String> apiKeys)
            throws IOException, RefusedByAgentException, InterruptedException {
        for (Registration device : leftovers(wanted)) {
            agent.removeDevice(scope, device.device());
            devices.remove(device.device());
        }
        if (leftovers(wanted).isEmpty()) {
            for (String apiKey : List.copyOf(ownGroups)) {
                if (!apiKeys.contains(apiKey)) {
                    agent.removeGroup(scope, apiKey);
                    ownGroups.remove(apiKey);
                    groups.remove(apiKey);
                }
            }
        }
    }

    /** Whether all that is here of ours is wanted. */
    boolean isClean(Set<String> wanted, Set<String> apiKeys) {
        return leftovers(wanted).isEmpty() && apiKeys.containsAll(ownGroups);
    }

    private List<Registration> leftovers(Set<String> wanted) {
        return devices.values().stream()
                .filter(device -> !wanted.contains(device.device()))
                .filter(device -> registrations.isOurs(device.apiKey(), device.mission()))
                .limit(BATCH)
                .toList();
    }
}
