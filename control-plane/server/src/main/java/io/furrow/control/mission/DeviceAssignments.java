package io.furrow.control.mission;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import io.furrow.control.manager.EventPublisher;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

/**
 * Writes the devices of missions to {@code service.devices}, a bounded number per transaction; the rest is a
 * {@link PendingAssignment}. A device is on one mission at a time, even while the mission's devices are still being
 * written.
 */
record DeviceAssignments(
        MissionTables tables,
        DeviceListStore lists,
        MissionSettings options,
        SharedStores farm,
        EventPublisher publisher) {
    /** Starts to request all devices of a mission; none if one of them is on another mission. Returns their number. */
    int assign(Mission mission, long now) throws RejectedException {
        List<DesiredDevice> planned = planned(mission, now);
        Set<String> pendingKeys = pendingKeysBeside(mission);
        checkFree(mission, planned, pendingKeys);
        checkRoom(planned, pendingKeys);
        advance(mission, new PendingAssignment(mission.mission(), PendingAssignment.Kind.START, 0, now));
        return planned.size();
    }

    private void checkFree(Mission mission, List<DesiredDevice> planned, Set<String> pendingKeys)
            throws RejectedException {
        Set<String> keys = new HashSet<>();
        for (DesiredDevice desired : planned) {
            String key = desired.version().key();
            String id = desired.version().id();
            DeviceState existing = tables.devices().get(key);
            boolean isAssigned = existing != null
                    && existing.device().running()
                    && !existing.mission().equals(mission.mission());
            if (isAssigned) {
                throw new RejectedException(
                        ErrorCode.DEVICE_TAKEN,
                        "device '%s' is on mission '%s'; stop that first".formatted(id, existing.mission()));
            }
            if (pendingKeys.contains(key)) {
                throw new RejectedException(
                        ErrorCode.DEVICE_TAKEN, "device '%s' is on another mission; stop that first".formatted(id));
            }
            if (!keys.add(key)) {
                throw new RejectedException(
                        ErrorCode.DEVICE_TAKEN, "device '%s' is twice on the mission".formatted(id));
            }
        }
    }

    private void checkRoom(List<DesiredDevice> planned, Set<String> pendingKeys) throws RejectedException {
        long added = planned.stream()
                .map(desired -> desired.version().key())
                .filter(key -> !tables.devices().contains(key))
                .count();
        long unwritten = pendingKeys.stream()
                .filter(key -> !tables.devices().contains(key))
                .count();
        farm.quota().require((added + unwritten) * Limits.DEVICE_BYTES);
    }

    /** Returns the devices of other starting missions of which some are not written yet. */
    private Set<String> pendingKeysBeside(Mission mission) {
        Set<String> keys = new HashSet<>();
        tables.pending().forEach(pending -> {
            if (pending.kind() == PendingAssignment.Kind.START
                    && !pending.mission().equals(mission.mission())) {
                Mission other = tables.missions().get(pending.mission());
                planned(other, 0).forEach(device -> keys.add(device.version().key()));
            }
        });
        return keys;
    }

    /**
     * Starts to withdraw the request for all of its devices. Their records stay, so that jobs can attribute earlier
     * reports. Returns the number of simulated devices, which have to stop; of real devices only the login ends.
     */
    int release(Mission mission, long now) {
        int simulated = 0;
        for (DeviceState existing : of(mission)) {
            simulated += existing.device().running() && existing.device().simulated() ? 1 : 0;
        }
        advance(mission, new PendingAssignment(mission.mission(), PendingAssignment.Kind.STOP, 0, now));
        return simulated;
    }

    /** Whether some devices of a mission are not written yet. */
    boolean isPending(String mission) {
        return tables.pending().get(mission) != null;
    }

    /** Writes the next devices of an assignment. Returns whether it is done. */
    boolean advance(Mission mission, PendingAssignment pending) {
        List<DesiredDevice> planned = planned(mission, pending.time());
        int end = Math.min(planned.size(), pending.next() + options.devicesPerStep());
        for (DesiredDevice desired : planned.subList(Math.min(pending.next(), end), end)) {
            if (pending.kind() == PendingAssignment.Kind.START) {
                put(desired);
            } else {
                stop(mission, desired.version().key(), pending.time());
            }
        }
        boolean done = end == planned.size();
        tables.pending().put(mission.mission(), done ? null : pending.at(end));
        return done;
    }

    private void stop(Mission mission, String key, long time) {
        DeviceState existing = tables.devices().get(key);
        if (existing != null
                && existing.mission().equals(mission.mission())
                && existing.device().running()) {
            DeviceVersion version = existing.device().version();
            put(existing.device().with(version.endingAt(Math.max(time, version.from())), false));
        }
    }

    /**
     * Gives a device new credentials. Its confirmation stays unchanged: its host reports whether it works with the new
     * ones.
     *
     * @param id of its entity
     * @return the new generation
     */
    int rotateCredentials(String id) throws RejectedException {
        DeviceState existing = tables.devices().get(options.scope().identity(id));
        if (existing == null || existing.forgotten()) {
            throw new RejectedException(ErrorCode.UNKNOWN_DEVICE, "there is no device '%s'".formatted(id));
        }
        if (existing.device().device() == null) {
            throw new RejectedException(
                    ErrorCode.NO_CREDENTIALS,
                    "device '%s' has its own login, which the control plane does not know; list the device as an object with a 'type' to give it credentials"
                            .formatted(id));
        }
        DesiredDevice rotated =
                existing.device().withGeneration(existing.device().generation() + 1);
        String key = rotated.version().key();
        put(rotated);
        tables.devices().put(key, tables.devices().get(key).reported(existing.confirmed(), existing.reason()));
        return rotated.generation();
    }

    void forget(Mission mission) {
        tables.pending().put(mission.mission(), null);
        forget(mission, Set.of());
    }

    /** Deletes the records of a mission's previous devices except those still listed. A pending stop is completed for these. */
    void forgetAllBut(List<DeviceState> before, Mission now) {
        Set<String> retained = new HashSet<>();
        planned(now, 0).forEach(device -> retained.add(device.version().key()));
        forget(before, retained);
        PendingAssignment pending = tables.pending().get(now.mission());
        if (pending != null && pending.kind() == PendingAssignment.Kind.STOP) {
            retained.forEach(key -> stop(now, key, pending.time()));
            tables.pending().put(now.mission(), null);
        }
    }

    private void forget(Mission mission, Set<String> retained) {
        forget(of(mission), retained);
    }

    private void forget(List<DeviceState> devices, Set<String> retained) {
        for (DeviceState existing : devices) {
            String key = existing.device().version().key();
            if (!retained.contains(key)) {
                // Preserves the generation: else a new device of the same name would accept a revoked password again.
                tables.devices().put(key, existing.generation() == 0 ? null : existing.asForgotten());
                farm.quota().use(existing.generation() == 0 ? -Limits.DEVICE_BYTES : 0);
                publisher.put(Topics.DEVICES, key, null);
            }
        }
    }

    /** Returns some devices with reasons: those that are not up, or, for a mission that is not desired, still simulated. */
    List<MissionStatus.Missing> missing(Mission mission) {
        return of(mission).stream()
                .filter(existing -> !existing.confirmed()
                        && (mission.running() || existing.device().simulated()))
                .limit(MissionStatus.MAX_NAMED)
                .map(DeviceState::missing)
                .toList();
    }

    /** Returns its devices that are not on another mission now. */
    List<DeviceState> of(Mission mission) {
        List<DeviceState> own = new ArrayList<>();
        for (DesiredDevice each : planned(mission, 0)) {
            DeviceState existing = tables.devices().get(each.version().key());
            if (existing != null && !existing.forgotten() && existing.mission().equals(mission.mission())) {
                own.add(existing);
            }
        }
        return own;
    }

    private List<DesiredDevice> planned(Mission mission, long from) {
        return PlannedDevices.of(mission, lists.groups(mission), options, from);
    }

    private void put(DesiredDevice device) {
        DeviceVersion version = device.version();
        DeviceState existing = tables.devices().get(version.key());
        DesiredDevice numbered = device.with(version.numbered(farm.sequence().next()), device.running())
                .withGeneration(Math.max(device.generation(), existing == null ? 0 : existing.generation()));
        if (existing == null) {
            farm.quota().use(Limits.DEVICE_BYTES);
        }
        tables.devices().put(version.key(), DeviceState.requested(numbered, existing));
        publisher.put(Topics.DEVICES, version.key(), numbered.toBytes());
    }
}
