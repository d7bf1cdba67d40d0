package io.furrow.control.health;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.EnumSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import io.furrow.control.alarm.AlarmCommandHandler;
import io.furrow.control.alarm.AlarmGroup;
import io.furrow.control.alarm.Cause;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.text.Counts;
import io.furrow.model.topic.Topics;

/**
 * Reconciles the alarms of silence with the silent devices: one alarm per mission; if a large share of a mission is
 * silent, a mission alarm that inhibits the former; if no device reports at all, a farm alarm that inhibits all others.
 * Muted devices do not count as silent; devices that are off do not count at all.
 *
 * <p>The state of devices is held in memory and rebuilt at the start.
 */
final class SilenceAlarmReconciler {
    /** Minimum time without any report before the farm counts as silent. */
    static final Duration FARM_QUIET = Duration.ofSeconds(30);
    /** How long the farm's alarm inhibits the others after reports arrive again, so that the devices have time to report. */
    static final Duration RECOVERY = Duration.ofMinutes(1);

    private static final int NAMED = 3;
    private static final Set<AlarmKind> KINDS =
            EnumSet.of(AlarmKind.SILENT_DEVICE, AlarmKind.SILENT_MISSION, AlarmKind.SILENT_FARM);
    private static final Comparator<MonitoredDevice> OLDEST =
            Comparator.comparingLong(MonitoredDevice::since).thenComparing(MonitoredDevice::id);

    private final HealthOptions options;
    private final AlarmCommandHandler alarms;
    private final Function<String, Optional<DeviceConnection>> connections;
    private final Map<String, MonitoredDevice> devices = new HashMap<>();
    private long lastReport;
    private Long resumed;

    /**
     * The relevant state of a device.
     *
     * @param group its mission's entity
     * @param heard when its last report was received, epoch ms; null if none was
     * @param silentAfter after how long without a report it is silent, ms
     * @param cause why it is silent; null if unknown
     */
    record MonitoredDevice(
            String id,
            String type,
            FiwareScope scope,
            String group,
            boolean silent,
            boolean off,
            long since,
            Long heard,
            long silentAfter,
            SilenceCause cause) {
        static MonitoredDevice of(DeviceHealth health, long silentAfter) {
            return new MonitoredDevice(
                    health.device().id(),
                    health.device().type(),
                    FiwareScope.of(health.device().service(), health.device().servicePath()),
                    AlarmGroup.of(health.device().mission(), health.device().domain()),
                    health.silent(),
                    health.report().off(),
                    health.since(),
                    health.report().heard(),
                    silentAfter,
                    null);
        }

        MonitoredDevice withCause(SilenceCause newCause) {
            return new MonitoredDevice(id, type, scope, group, silent, off, since, heard, silentAfter, newCause);
        }

        String named() {
            return cause == null ? id : id + " (" + cause.text() + ")";
        }
    }

    /** The devices of a group that are not off. */
    private static final class GroupSummary {
        private final List<MonitoredDevice> silent = new ArrayList<>();
        private int total;
        private double expectedPerMs;

        void add(MonitoredDevice device, boolean isSilent) {
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

        /** For instance {@code 1 of 2 devices is}. @param whose follows the devices */
        String silentOf(String whose) {
            return Counts.areOf(silent.size(), total, "device", whose);
        }

        List<Cause.AffectedDevice> some() {
            return silent.stream()
                    .sorted(OLDEST)
                    .limit(Cause.MAX_DEVICES)
                    .map(device -> Cause.AffectedDevice.of(device.id(), device.type(), device.scope()))
                    .toList();
        }

        /** The causes in the list of {@link #named()}. */
        List<Cause.Detail> details() {
            return silent.stream()
                    .sorted(OLDEST)
                    .limit(NAMED)
                    .filter(device -> device.cause() != null)
                    .map(device -> new Cause.Detail(
                            device.id(), device.cause().code(), device.cause().values()))
                    .toList();
        }

        /** Human-readable list: some by their ids, the rest by number. */
        String named() {
            String ids = silent.stream()
                    .sorted(OLDEST)
                    .limit(NAMED)
                    .map(MonitoredDevice::named)
                    .collect(Collectors.joining(", "));
            return silent.size() <= NAMED ? ids : ids + " and " + (silent.size() - NAMED) + " more";
        }
    }

    /** @param connections returns the reported connection of a device by key */
    SilenceAlarmReconciler(
            HealthOptions options,
            AlarmCommandHandler alarms,
            Function<String, Optional<DeviceConnection>> connections) {
        this.options = options;
        this.alarms = alarms;
        this.connections = connections;
    }

    void put(String key, MonitoredDevice device) {
        devices.put(key, device.silent() ? device.withCause(cause(key, device)) : device);
    }

    /** Returns the cause of the silence; a cause of which only the count has changed is renewed with a delay. */
    private SilenceCause cause(String key, MonitoredDevice device) {
        SilenceCause cause = connections
                .apply(key)
                .flatMap(connection -> SilenceCause.of(connection, device.heard()))
                .orElse(null);
        MonitoredDevice before = devices.get(key);
        SilenceCause shown = before == null ? null : before.cause();
        return cause == null || cause.replaces(shown) ? cause : shown;
    }

    void remove(String key) {
        devices.remove(key);
    }

    /**
     * Records that a device reported.
     *
     * @param time epoch ms, by the clock of the control plane
     */
    void reported(long time) {
        lastReport = Math.max(lastReport, time);
    }

    /**
     * Updates the alarms.
     *
     * @param startedAt since when reports of devices are read, epoch ms
     */
    void reconcile(long startedAt, long now) {
        Map<String, GroupSummary> groups = new TreeMap<>();
        GroupSummary all = new GroupSummary();
        for (MonitoredDevice device : devices.values()) {
            if (!device.off() && !isMissing(device)) {
                boolean silent = device.silent() && !isMuted(device, now);
                all.add(device, silent);
                groups.computeIfAbsent(device.group(), any -> new GroupSummary())
                        .add(device, silent);
            }
        }
        List<Cause> causes = new ArrayList<>();
        Cause farm = farm(all, startedAt, now);
        if (farm != null) {
            alarms.report(farm, null, now);
            causes.add(farm);
        }
        groups.forEach((group, members) -> report(group, members, farm, now, causes));
        alarms.endOthers(KINDS, causes, "its devices report again or were stopped", now);
    }

    /** Whether it is muted: by its id, with tenant and service path, or with its type too. */
    private boolean isMuted(MonitoredDevice device, long now) {
        FiwareScope scope = device.scope();
        String type = device.type() == null ? "" : device.type();
        return Stream.of(device.id(), scope.identity(device.id()), scope.identity(type, device.id()))
                .anyMatch(each -> alarms.isMuted(AlarmKind.SILENT_DEVICE, each, now));
    }

    /** Whether the alarm for missing devices of its mission covers the device already. */
    private boolean isMissing(MonitoredDevice device) {
        return device.heard() == null && alarms.isRaised(AlarmKind.MISSING_DEVICES, device.group());
    }

    private void report(String group, GroupSummary members, Cause farm, long now, List<Cause> causes) {
        if (members.silent.isEmpty()) {
            return;
        }
        String text = members.silentOf(" of " + AlarmGroup.label(group)) + " silent";
        Cause inhibitor = farm;
        if (isShareReached(members, alarms.isRaised(AlarmKind.SILENT_MISSION, group))) {
            String unavailable = text + ": probably the site or its connection rather than the devices";
            inhibitor = Cause.ofMany(AlarmKind.SILENT_MISSION, group, unavailable, members.some(), members.extent());
            alarms.report(inhibitor, farm, now);
            causes.add(inhibitor);
        }
        String named = text + ": " + members.named();
        Cause some = Cause.ofMany(AlarmKind.SILENT_DEVICE, group, named, members.some(), members.extent())
                .withDetails(members.details());
        alarms.report(some, inhibitor, now);
        causes.add(some);
    }

    /**
     * Whether the share of silent devices is reached. Half of the share suffices if the alarm is raised already, so
     * that it does not flap.
     */
    private boolean isShareReached(GroupSummary members, boolean wasRaised) {
        double share = (double) members.silent.size() / Math.max(1, members.total);
        return wasRaised
                ? share >= options.missionShare() / 2
                : share >= options.missionShare() && members.silent.size() >= HealthOptions.MIN_OF_MISSION;
    }

    /**
     * Returns null if the farm is not silent. It is silent if most devices are silent and no report has arrived for
     * longer than the other devices together may take, at least {@link #FARM_QUIET}. After reports arrive again it
     * recovers for as long, at least {@link #RECOVERY}, or until no device is silent.
     */
    private Cause farm(GroupSummary all, long startedAt, long now) {
        boolean wasRaised = alarms.isRaised(AlarmKind.SILENT_FARM, Topics.RAW);
        lastReport = Math.min(lastReport, now); // the clock may have been set back
        resumed = resumed == null ? null : Long.valueOf(Math.min(resumed, now));
        double expectedInterval = all.expectedPerMs == 0 ? 0 : 1 / all.expectedPerMs;
        double minQuiet = Math.max(FARM_QUIET.toMillis(), expectedInterval);
        boolean unreported = wasRaised && lastReport == 0; // since this process began to read
        boolean quiet = unreported || now - Math.max(lastReport, startedAt) > minQuiet;
        if (quiet || !wasRaised) {
            resumed = null;
        } else if (resumed == null) {
            resumed = now;
        }
        if (quiet && isShareReached(all, wasRaised)) {
            return farm("nothing arrives on %s: %s silent", all);
        }
        boolean recovers = resumed != null && now - resumed < Math.max(RECOVERY.toMillis(), minQuiet);
        return recovers && !all.silent.isEmpty() ? farm("reports arrive on %s again: %s still silent", all) : null;
    }

    private static Cause farm(String text, GroupSummary all) {
        return Cause.ofMany(
                AlarmKind.SILENT_FARM,
                Topics.RAW,
                text.formatted(Topics.RAW, all.silentOf("")),
                all.some(),
                all.extent());
    }
}
