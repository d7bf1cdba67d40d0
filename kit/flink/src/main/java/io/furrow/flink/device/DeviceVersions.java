package io.furrow.flink.device;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import io.furrow.model.device.DeviceVersion;

/**
 * What was known of a device at any time that is still asked for.
 *
 * @param versions by {@code from}, which none shares with another; each holds until the next one's
 */
public record DeviceVersions(List<DeviceVersion> versions) {
    public static final DeviceVersions EMPTY = new DeviceVersions(List.of());

    /** The version that held at an event time. */
    public Optional<DeviceVersion> at(long time) {
        for (int i = versions.size() - 1; i >= 0; i--) {
            if (versions.get(i).from() <= time) {
                return Optional.of(versions.get(i)).filter(version -> version.holdsAt(time));
            }
        }
        return Optional.empty();
    }

    /** With a change; a version with a smaller sequence than one known is out of date and changes nothing. */
    public DeviceVersions with(DeviceChange change) {
        return change.version() == null ? endedAt(change.time()) : with(change.version());
    }

    /** What a version says holds from its time on, whatever was said of that time before. */
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

    /** Without what had ended at a time. */
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
