package io.furrow.flink.device;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import io.furrow.model.device.DeviceVersion;

/**
 * The retained versions of a device.
 *
 * @param versions by distinct {@code from}; each is valid until the next one's
 */
public record DeviceVersions(List<DeviceVersion> versions) {
    public static final DeviceVersions EMPTY = new DeviceVersions(List.of());

    /** The version valid at an event time. */
    public Optional<DeviceVersion> at(long time) {
        for (int i = versions.size() - 1; i >= 0; i--) {
            if (versions.get(i).from() <= time) {
                return Optional.of(versions.get(i)).filter(version -> version.holdsAt(time));
            }
        }
        return Optional.empty();
    }

    /** Adds a change; a version with a smaller sequence than an existing one is outdated and ignored. */
    public DeviceVersions with(DeviceChange change) {
        return change.version() == null ? endedAt(change.time()) : with(change.version());
    }

    /** A version replaces everything from its time on. */
    private DeviceVersions with(DeviceVersion version) {
        if (versions.stream().anyMatch(known -> known.sequence() > version.sequence())) {
            return this;
        }
        List<DeviceVersion> all = new ArrayList<>(versions);
        all.removeIf(known -> known.from() >= version.from() || known.sequence() == version.sequence());
        all.add(version);
        return new DeviceVersions(all);
    }

    private DeviceVersions endedAt(long time) {
        List<DeviceVersion> all = new ArrayList<>(versions);
        all.removeIf(known -> known.from() >= time);
        if (!all.isEmpty() && all.get(all.size() - 1).holdsAt(time)) {
            all.set(all.size() - 1, all.get(all.size() - 1).endingAt(time));
        }
        return new DeviceVersions(all);
    }

    /** Without the versions that had ended at a time. */
    public DeviceVersions since(long time) {
        List<DeviceVersion> kept = new ArrayList<>();
        for (int i = 0; i < versions.size(); i++) {
            boolean followed = i + 1 < versions.size() && versions.get(i + 1).from() <= time;
            Long until = versions.get(i).until();
            if (!followed && (until == null || until > time)) {
                kept.add(versions.get(i));
            }
        }
        return kept.size() == versions.size() ? this : new DeviceVersions(kept);
    }

    public boolean isEmpty() {
        return versions.isEmpty();
    }
}
