package io.furrow.provisioner;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import io.furrow.model.device.DesiredDevice;
import io.furrow.provisioner.AgentClient.Group;

/**
 * What may be removed. A Kafka that is empty, or not the one for which devices were provisioned, wants none of them, and would take the
 * farm out of service: it removes only what it has itself wanted since the start.
 */
final class RemovalGuard {
    /** Missions, and mission and id of devices. */
    private final Set<List<String>> own = new HashSet<>();

    private boolean all;

    /**
     * The Kafka of which the desired devices are.
     *
     * @param topic id of its topic of devices, another one where that was made again; empty if it is not known
     * @param provisioned whether it is known that its devices were provisioned at this IoT Agent before
     */
    record Origin(String topic, boolean provisioned) {
        static final Origin UNKNOWN = new Origin("", false);
    }

    /**
     * What is not wanted and was not removed, because another Kafka may want it.
     *
     * @param accounts users at the MQTT brokers
     * @param devices ids at the IoT Agent
     * @param groups missions that have a service group there
     */
    record Retained(List<String> accounts, List<String> devices, List<String> groups) {
        private static final int MAX_NAMED = 10;

        Retained(Collection<String> accounts, Collection<String> devices, Collection<String> groups) {
            this(sorted(accounts), sorted(devices), sorted(groups));
        }

        boolean isEmpty() {
            return accounts.isEmpty() && devices.isEmpty() && groups.isEmpty();
        }

        /** Without names, for everybody. */
        String summary() {
            return "%d MQTT accounts, %d devices and %d service groups of the IoT Agent stay, though this Kafka does not want them"
                    .formatted(accounts.size(), devices.size(), groups.size());
        }

        /** What, why and what to do. */
        String text() {
            List<String> names = new ArrayList<>(devices.isEmpty() ? accounts : devices);
            names.addAll(names.isEmpty() ? groups : List.of());
            String named = String.join(", ", names.subList(0, Math.min(names.size(), MAX_NAMED)));
            return "%s: it is empty, or another than the one for which they were made (%s%s). Check --kafka; after a loss of Kafka's data start their missions again; --forget-devices removes what is not wanted"
                    .formatted(summary(), named, names.size() > MAX_NAMED ? ", …" : "");
        }

        private static List<String> sorted(Collection<String> names) {
            return names.stream().sorted().toList();
        }
    }

    /** @param everything whether all that is not wanted may be removed */
    void startAnew(boolean everything) {
        own.clear();
        all = everything;
    }

    /** Everything that there is, is wanted: what is no longer wanted later was of this Kafka. */
    void allowAll() {
        all = true;
    }

    boolean allowsAll() {
        return all;
    }

    void desired(Collection<DesiredDevice> devices) {
        for (DesiredDevice device : devices) {
            own.add(List.of(device.version().mission()));
            own.add(List.of(device.version().mission(), device.device()));
        }
    }

    boolean allows(AgentRegistration device) {
        return all || own.contains(List.of(device.mission(), device.device()));
    }

    boolean allows(Group group) {
        return all || own.contains(List.of(group.mission()));
    }
}
