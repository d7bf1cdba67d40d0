package io.furrow.control.alarm;

import java.time.Duration;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import io.furrow.control.manager.Table;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.time.Elapsed;

/** Limits the number of open alarms per kind and mission or field. Causes beyond the limit are counted and share one group alarm. */
final class AlarmLimit {
    /** Maximum number of alarms per kind and group; further causes are only counted. */
    static final int MAX_ALARMS = 20;
    /** Maximum number of counted causes per kind and group; further causes are not stored until there is room. */
    static final int MAX_COUNTED = 1000;

    /** Kinds that are raised per subject. */
    static final Set<AlarmKind> KINDS = Stream.of(AlarmKind.values())
            .filter(kind -> template(kind) != null)
            .collect(Collectors.toUnmodifiableSet());

    private static final long RECOUNT_INTERVAL = Duration.ofSeconds(10).toMillis();
    private static final long SEEN_INTERVAL = Duration.ofSeconds(10).toMillis();
    /** Validity from which the resolution of {@link #SEEN_INTERVAL} is negligible. */
    private static final long LONG = Duration.ofMinutes(30).toMillis();

    private final Table<Group> groups;
    private final Table<Overflow> overflows;
    private long recounted;

    /**
     * Alarms and counted causes of a kind and group.
     *
     * @param key kind and group
     * @param alarms number of open alarms
     * @param counted number of causes without an alarm
     * @param devices some of the devices concerned
     */
    record Group(
            String key, AlarmKind kind, String group, int alarms, int counted, List<Cause.AffectedDevice> devices) {
        Group with(int newAlarms, int newCounted) {
            return new Group(key, kind, group, newAlarms, newCounted, devices);
        }
    }

    /**
     * A cause without an alarm.
     *
     * @param key kind and identity
     * @param until end of validity, epoch ms; null if it lasts until ended explicitly
     * @param seen when it was last reported, epoch ms, with a resolution of {@link #SEEN_INTERVAL}
     */
    record Overflow(
            String key, AlarmKind kind, String group, List<Cause.AffectedDevice> devices, Long until, long seen) {
        /** As {@link Alarm#notAfter}. */
        private Overflow seenAt(long now) {
            return new Overflow(
                    key, kind, group, devices, until == null ? null : Long.valueOf(until - seen + now), now);
        }
    }

    AlarmLimit(Table<Group> groups, Table<Overflow> overflows) {
        this.groups = groups;
        this.overflows = overflows;
    }

    /**
     * Returns the record of a kind and identity, also if it was stored by a result without types, whose identity lacks
     * them; null if there is none.
     */
    static <T> T find(Table<T> records, AlarmKind kind, String identity) {
        T found = records.get(Cause.key(kind, identity));
        String[] parts = identity.split("\\|", 4);
        if (found == null && parts.length == 4 && KINDS.contains(kind)) {
            found = records.get(Cause.key(kind, parts[0] + "|" + parts[1] + "||" + parts[3]));
        }
        return found;
    }

    /**
     * Counts a cause that has no alarm yet.
     *
     * @return whether it was counted; if not, the caller raises an alarm
     */
    boolean count(Cause cause, long now) {
        if (cause.group() == null) {
            return false;
        }
        Group group = group(cause.kind(), cause.group());
        Overflow before = find(overflows, cause.kind(), cause.identity());
        boolean existing = before != null;
        if (!existing && group.alarms() < MAX_ALARMS) {
            return false;
        }
        boolean isWithinMax = group.counted() < MAX_COUNTED;
        String key = existing ? before.key() : cause.key();
        Overflow counting = new Overflow(key, cause.kind(), cause.group(), cause.devices(), cause.until(now), now);
        if (existing ? isUpdate(before, counting) : isWithinMax) {
            overflows.put(key, counting);
        }
        if (!existing && isWithinMax) {
            store(new Group(
                    group.key(),
                    group.kind(),
                    group.group(),
                    group.alarms(),
                    group.counted() + 1,
                    joined(group.devices(), cause.devices())));
        }
        return true;
    }

    private static boolean isUpdate(Overflow before, Overflow now) {
        boolean validityChanged =
                !(lastsLong(before) && lastsLong(now)) && !Objects.equals(before.until(), now.until());
        return validityChanged || Elapsed.hasPassed(SEEN_INTERVAL, before.seen(), now.seen());
    }

    private static boolean lastsLong(Overflow cause) {
        return cause.until() != null && cause.until() - cause.seen() >= LONG;
    }

    /**
     * Removes the counted causes of a group, whose ends may have been lost, unless one was reported recently.
     *
     * @return whether they were removed
     */
    boolean clear(AlarmKind kind, String group, long now) {
        List<Overflow> members =
                overflows.where(each -> each.kind() == kind && each.group().equals(group));
        if (members.stream()
                .anyMatch(each -> !Elapsed.hasPassed(AlarmStateMachine.ACTIVE_TIMEOUT.toMillis(), each.seen(), now))) {
            return false;
        }
        members.forEach(each -> overflows.put(each.key(), null));
        store(group(kind, group).with(group(kind, group).alarms(), 0));
        return true;
    }

    /** Removes the counted cause of a kind and identity, if there is one. */
    void end(AlarmKind kind, String identity) {
        Overflow existing = find(overflows, kind, identity);
        if (existing != null) {
            overflows.put(existing.key(), null);
            Group group = group(kind, existing.group());
            store(group.with(group.alarms(), Math.max(0, group.counted() - 1)));
        }
    }

    /** Sets the end of the counted cause of a kind and identity, if there is one. */
    void endAt(AlarmKind kind, String identity, long until) {
        Overflow existing = find(overflows, kind, identity);
        if (existing != null) {
            overflows.put(
                    existing.key(),
                    new Overflow(existing.key(), kind, existing.group(), existing.devices(), until, existing.seen()));
        }
    }

    /** Updates the number of alarms after one was opened or closed. */
    void changed(Alarm alarm, int by) {
        if (alarm.group() != null && !alarm.isOfGroup()) {
            Group group = group(alarm.kind(), alarm.group());
            store(group.with(Math.max(0, group.alarms() + by), group.counted()));
        }
    }

    /** Removes expired causes and returns the causes of the group alarms. */
    List<Cause> causes(long now) {
        if (Elapsed.hasPassed(RECOUNT_INTERVAL, recounted, now)) {
            recounted = now;
            recount(now);
        }
        return groups.where(group -> group.counted() > 0).stream()
                .map(group -> Cause.ofMany(
                        group.kind(),
                        group.group(),
                        text(group),
                        group.devices(),
                        new Cause.Extent(group.counted(), null)))
                .toList();
    }

    private void recount(long now) {
        overflows.where(each -> each.seen() > now).forEach(each -> overflows.put(each.key(), each.seenAt(now)));
        overflows
                .where(each -> each.until() != null && each.until() <= now)
                .forEach(each -> overflows.put(each.key(), null));
        Map<String, List<Overflow>> byGroup =
                overflows.all().stream().collect(Collectors.groupingBy(each -> Cause.key(each.kind(), each.group())));
        for (Group group : groups.all()) {
            List<Overflow> members = byGroup.getOrDefault(group.key(), List.of());
            List<Cause.AffectedDevice> devices = List.of();
            for (Overflow each : members) {
                devices = joined(devices, each.devices());
            }
            store(new Group(group.key(), group.kind(), group.group(), group.alarms(), members.size(), devices));
        }
    }

    private static List<Cause.AffectedDevice> joined(
            List<Cause.AffectedDevice> some, List<Cause.AffectedDevice> others) {
        if (some.size() >= Cause.MAX_DEVICES) {
            return some;
        }
        Set<Cause.AffectedDevice> joined = new LinkedHashSet<>(some);
        joined.addAll(others);
        return joined.stream().limit(Cause.MAX_DEVICES).toList();
    }

    private Group group(AlarmKind kind, String group) {
        String key = Cause.key(kind, group);
        Group existing = groups.get(key);
        return existing == null ? new Group(key, kind, group, 0, 0, List.of()) : existing;
    }

    private void store(Group group) {
        Group stored = group.alarms() == 0 && group.counted() == 0 ? null : group;
        if (!Objects.equals(stored, groups.get(group.key()))) {
            groups.put(group.key(), stored);
        }
    }

    private static String text(Group group) {
        String number = group.counted() < MAX_COUNTED ? group.counted() + " more" : MAX_COUNTED + " or more further";
        return template(group.kind()).formatted(number, AlarmGroup.label(group.group()));
    }

    /** Text of a group alarm; null for a kind that is not raised per subject. */
    private static String template(AlarmKind kind) {
        return switch (kind) {
            case COLLISION -> "%s pairs of %s are too close";
            case PREDICTED_ENCOUNTER -> "%s encounters of %s are predicted";
            case SUSPECT_SENSOR -> "%s sensors of %s deviate from the others";
            case CLOCK_BEHIND -> "reports of %s devices of %s arrive too late and are dropped";
            case MISSING_DEVICES, SILENT_DEVICE, SILENT_MISSION, SILENT_FARM, FAULT -> null;
        };
    }
}
