package io.furrow.control.health;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.EnumSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;

import io.furrow.control.alarm.AlarmDesk;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.topic.Topics;

/**
 * Reconciles the alarms of silence with the devices that are silent: one alarm per mission; where much of a mission is silent, one
 * that says so and inhibits the former; where nothing arrives from any device, one for the farm that inhibits all others. Devices
 * that are muted do not count as silent, those that are off not at all.
 *
 * <p>What is known of devices is held in memory and put anew at the start.
 */
final class Silence {
    /** The least time without any report after which nothing is taken to arrive. */
    static final Duration FARM_QUIET = Duration.ofSeconds(30);
    /** How long the farm's alarm inhibits the others after reports arrive again, so that devices can report first. */
    static final Duration RECOVERY = Duration.ofMinutes(1);

    private static final int NAMED = 3;
    private static final Set<AlarmKind> KINDS =
            EnumSet.of(AlarmKind.SILENT_DEVICE, AlarmKind.SILENT_MISSION, AlarmKind.SILENT_FARM);
    private static final Comparator<Device> OLDEST =
            Comparator.comparingLong(Device::since).thenComparing(Device::id);

    private final HealthOptions options;
    private final AlarmDesk alarms;
    private final Map<String, Device> devices = new HashMap<>();
    private long lastReport;
    private Long resumed;

    /**
     * What counts of a device.
     *
     * @param group its mission's entity
     * @param silentAfter how long it may say nothing, ms
     */
    record Device(String id, String type, String group, boolean silent, boolean off, long since, long silentAfter) {
        static Device of(DeviceHealth health, long silentAfter) {
            return new Device(
                    health.id(),
                    health.type(),
                    AlarmGroup.of(health.mission(), health.domain()),
                    health.silent(),
                    health.off(),
                    health.since(),
                    silentAfter);
        }
    }

    /** The devices of a group that are not off. */
    private static final class Members {
        private final List<Device> silent = new ArrayList<>();
        private int total;
        private double expectedPerMs;

        void add(Device device, boolean isSilent) {
            total++;
            if (isSilent) {
                silent.add(device);
            } else {
                expectedPerMs += 1.0 / Math.max(1, device.silentAfter());
            }
        }

        Cause.Extent extent() {
            return new Cause.Extent(silent.size(), total);
        }

        List<Cause.Device> some() {
            return silent.stream()
                    .sorted(OLDEST)
                    .limit(Cause.MAX_DEVICES)
                    .map(device -> new Cause.Device(device.id(), device.type()))
                    .toList();
        }

        /** For people: some by their ids, the rest by number. */
        String named() {
            String ids = some().stream().limit(NAMED).map(Cause.Device::id).collect(Collectors.joining(", "));
            return silent.size() <= NAMED ? ids : ids + " and " + (silent.size() - NAMED) + " more";
        }
    }

    Silence(HealthOptions options, AlarmDesk alarms) {
        this.options = options;
        this.alarms = alarms;
    }

    void put(String key, Device device) {
        devices.put(key, device);
    }

    void remove(String key) {
        devices.remove(key);
    }

    /** Some device reported. @param time epoch ms, by the clock of the control plane */
    void reported(long time) {
        lastReport = Math.max(lastReport, time);
    }

    /**
     * Brings the alarms up to date.
     *
     * @param began since when devices are listened to, epoch ms
     */
    void reconcile(long began, long now) {
        Map<String, Members> groups = new TreeMap<>();
        Members all = new Members();
        for (Device device : devices.values()) {
            if (!device.off()) {
                boolean silent = device.silent() && !alarms.isMuted(AlarmKind.SILENT_DEVICE, device.id(), now);
                all.add(device, silent);
                groups.computeIfAbsent(device.group(), any -> new Members()).add(device, silent);
            }
        }
        List<Cause> causes = new ArrayList<>();
        Cause farm = farm(all, began, now);
        if (farm != null) {
            alarms.report(farm, null, now);
            causes.add(farm);
        }
        groups.forEach((group, members) -> report(group, members, farm, now, causes));
        alarms.endOthers(KINDS, causes, "its devices report again, or are not to run any more", now);
    }

    private void report(String group, Members members, Cause farm, long now, List<Cause> causes) {
        if (members.silent.isEmpty()) {
            return;
        }
        String text = "%d of %d devices of %s are silent"
                .formatted(members.silent.size(), members.total, AlarmGroup.label(group));
        Cause inhibitor = farm;
        if (isMost(members, alarms.isRaised(AlarmKind.SILENT_MISSION, group))) {
            String away = text + ": rather the site or its connection than the devices";
            inhibitor = Cause.ofMany(AlarmKind.SILENT_MISSION, group, away, members.some(), members.extent());
            alarms.report(inhibitor, farm, now);
            causes.add(inhibitor);
        }
        String named = text + ": " + members.named();
        Cause some = Cause.ofMany(AlarmKind.SILENT_DEVICE, group, named, members.some(), members.extent());
        alarms.report(some, inhibitor, now);
        causes.add(some);
    }

    /** Whether so many are silent; half of the share is enough where that was said already, so that it is not said in turns. */
    private boolean isMost(Members members, boolean wasMost) {
        double share = (double) members.silent.size() / Math.max(1, members.total);
        return wasMost
                ? share >= options.missionShare() / 2
                : share >= options.missionShare() && members.silent.size() >= HealthOptions.LEAST_OF_MISSION;
    }

    /**
     * Null where the farm is not silent. It is when most devices are silent and nothing has arrived for three of the periods that the
     * devices that are not silent have together; then for a while after reports arrive again, until no device is silent.
     */
    private Cause farm(Members all, long began, long now) {
        boolean was = alarms.isRaised(AlarmKind.SILENT_FARM, Topics.RAW);
        double together = all.expectedPerMs == 0 ? 0 : 1 / all.expectedPerMs;
        double enough = Math.max(FARM_QUIET.toMillis(), together);
        boolean quiet = now - Math.max(lastReport, began) > enough;
        if (quiet || !was) {
            resumed = null;
        } else if (resumed == null) {
            resumed = now;
        }
        if (quiet && isMost(all, was)) {
            return farm("nothing arrives on %s: %d of %d devices are silent", all);
        }
        boolean recovers = resumed != null && now - resumed < Math.max(RECOVERY.toMillis(), enough);
        return recovers && !all.silent.isEmpty()
                ? farm("reports arrive on %s again: %d of %d devices are still silent", all)
                : null;
    }

    private static Cause farm(String text, Members all) {
        return Cause.ofMany(
                AlarmKind.SILENT_FARM,
                Topics.RAW,
                text.formatted(Topics.RAW, all.silent.size(), all.total),
                all.some(),
                all.extent());
    }
}
