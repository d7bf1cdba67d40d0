package io.furrow.control.mission;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Records;
import io.furrow.control.manager.Sequence;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RefusedException;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.topic.Topics;

/** Asks for the devices of missions on {@code service.devices}. A device is on one mission at a time. */
final class DeviceDesk {
    private final Records<DeviceState> devices;
    private final Sequence sequence;
    private final FiwareScope scope;
    private final Outbox outbox;

    DeviceDesk(Records<DeviceState> devices, Sequence sequence, FiwareScope scope, Outbox outbox) {
        this.devices = devices;
        this.sequence = sequence;
        this.scope = scope;
        this.outbox = outbox;
    }

    /** Asks for all devices of a mission, or for none of them where one is another's. Answers how many are hosted. */
    int ask(Mission mission, long now) throws RefusedException {
        List<WantedDevice> roster = Roster.of(mission, scope, now);
        Set<String> keys = new HashSet<>();
        for (WantedDevice wanted : roster) {
            DeviceState known = devices.get(wanted.version().key());
            boolean taken = known != null
                    && known.device().running()
                    && !known.mission().equals(mission.mission());
            if (taken || !keys.add(wanted.version().key())) {
                throw new RefusedException(
                        ErrorCode.DEVICE_TAKEN,
                        taken
                                ? "device '%s' is on mission '%s'; stop that first"
                                        .formatted(wanted.version().id(), known.mission())
                                : "device '%s' is twice on the mission"
                                        .formatted(wanted.version().id()));
            }
        }
        roster.forEach(this::put);
        return (int) roster.stream().filter(WantedDevice::isHosted).count();
    }

    /** Wants none of its devices from now on. Their records stay, so that jobs know to whom their past belongs. */
    void dismiss(Mission mission, long now) {
        for (DeviceState known : of(mission)) {
            WantedDevice device = known.device();
            if (device.running()) {
                DeviceVersion ended =
                        device.version().endingAt(Math.max(now, device.version().from()));
                put(new WantedDevice(ended, device.type(), device.device(), false, device.period(), device.settings()));
            }
        }
    }

    /** Forgets its devices, their past too. */
    void forget(Mission mission) {
        forget(mission, Set.of());
    }

    /** Forgets the devices of a mission as it was, but not those that it has as it is now. */
    void forgetAllBut(Mission before, Mission now) {
        Set<String> kept = new HashSet<>();
        Roster.of(now, scope, 0).forEach(device -> kept.add(device.version().key()));
        forget(before, kept);
    }

    private void forget(Mission mission, Set<String> kept) {
        for (DeviceState known : of(mission)) {
            String key = known.device().version().key();
            if (!kept.contains(key)) {
                devices.put(key, null);
                outbox.put(Topics.DEVICES, key, null);
            }
        }
    }

    /** Hosted devices that are not as they are wanted. */
    List<MissionStatus.Missing> missing(Mission mission) {
        List<MissionStatus.Missing> missing = new ArrayList<>();
        for (DeviceState known : of(mission)) {
            WantedDevice device = known.device();
            if (device.isHosted() && !known.confirmed() && missing.size() < MissionStatus.MOST_NAMED) {
                missing.add(new MissionStatus.Missing(device.version().id(), known.reason()));
            }
        }
        return missing;
    }

    /** Those of its devices that are still its own. */
    private List<DeviceState> of(Mission mission) {
        List<DeviceState> own = new ArrayList<>();
        for (WantedDevice each : Roster.of(mission, scope, 0)) {
            DeviceState known = devices.get(each.version().key());
            if (known != null && known.mission().equals(mission.mission())) {
                own.add(known);
            }
        }
        return own;
    }

    private void put(WantedDevice device) {
        DeviceVersion version = device.version();
        WantedDevice numbered = new WantedDevice(
                new DeviceVersion(
                        version.id(),
                        version.service(),
                        version.servicePath(),
                        version.domain(),
                        version.mission(),
                        version.from(),
                        version.until(),
                        sequence.next(),
                        version.carriedBy()),
                device.type(),
                device.device(),
                device.running(),
                device.period(),
                device.settings());
        devices.put(version.key(), DeviceState.asked(numbered));
        outbox.put(Topics.DEVICES, version.key(), numbered.toBytes());
    }
}
