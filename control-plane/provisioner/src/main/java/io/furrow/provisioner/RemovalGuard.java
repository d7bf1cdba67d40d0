package io.furrow.provisioner;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import io.furrow.model.control.Fault;
import io.furrow.model.device.DesiredDevice;
import io.furrow.provisioner.AgentClient.Group;

/**
 * Decides which devices and groups may be removed. An empty Kafka, or another than the one for which devices were
 * provisioned, desires none of them, and removing them would take the farm out of service. With such a Kafka, and while
 * a record of a device cannot be read, only devices that were desired since the start are removed.
 */
final class RemovalGuard {
    /** Missions, and pairs of mission and device id. */
    private final Set<List<String>> own = new HashSet<>();

    private boolean all;
    private boolean unreadable;

    /**
     * Identifies the Kafka cluster of the desired devices.
     *
     * @param topic id of its topic of devices, which changes when the topic is recreated; empty if unknown
     * @param provisioned whether its devices are known to have been provisioned at this IoT Agent
     */
    record Origin(String topic, boolean provisioned) {
        static final Origin UNKNOWN = new Origin("", false);
    }

    /**
     * What is not desired but was not removed, because another Kafka may need it.
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

        /** Returns a summary without names, for public pages. */
        String summary() {
            return "%d MQTT accounts, %d devices and %d service groups of the IoT Agent stay, although this Kafka does not contain them"
                    .formatted(accounts.size(), devices.size(), groups.size());
        }

        /** Returns what was retained, why, and what to do. */
        String text() {
            return "%s: it is empty, or they were created for another Kafka (%s). Check --kafka; after a loss of Kafka's data, start their missions again; --forget-devices removes those that are not desired"
                    .formatted(summary(), named());
        }

        Fault fault() {
            return new Fault(
                    text(),
                    "devices-retained",
                    Map.of(
                            "accounts", String.valueOf(accounts.size()),
                            "devices", String.valueOf(devices.size()),
                            "groups", String.valueOf(groups.size()),
                            "names", named()));
        }

        private String named() {
            List<String> names = new ArrayList<>(devices.isEmpty() ? accounts : devices);
            names.addAll(names.isEmpty() ? groups : List.of());
            String some = String.join(", ", names.subList(0, Math.min(names.size(), MAX_NAMED)));
            return names.size() > MAX_NAMED ? some + ", …" : some;
        }

        private static List<String> sorted(Collection<String> names) {
            return names.stream().sorted().toList();
        }
    }

    /** @param everything whether everything that is not desired may be removed */
    void reset(boolean everything) {
        own.clear();
        all = everything;
    }

    /** Called when everything that exists is desired: what is no longer desired later belongs to this Kafka. */
    void allowAll() {
        all = true;
    }

    boolean allowsAll() {
        return all && !unreadable;
    }

    /** @param exist whether there are records of devices that cannot be read: any device may be one of them */
    void unreadable(boolean exist) {
        unreadable = exist;
    }

    void desired(Collection<DesiredDevice> devices) {
        for (DesiredDevice device : devices) {
            own.add(List.of(device.version().mission()));
            own.add(List.of(device.version().mission(), device.device()));
        }
    }

    boolean allows(AgentRegistration device) {
        return allowsAll() || own.contains(List.of(device.mission(), device.device()));
    }

    boolean allows(Group group) {
        return allowsAll() || own.contains(List.of(group.mission()));
    }
}
