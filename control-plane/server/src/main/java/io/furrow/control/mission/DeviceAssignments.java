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
 * Writes the devices of missions to {@code service.devices}, a bounded number at a time: what is left is a {@link Rollout}. A device is
 * on one mission at a time, also while that is still being written.
 */
final class DeviceAssignments {
    private final MissionRecords records;
    private final MissionLists lists;
    private final MissionOptions options;
    private final FarmContext farm;
    private final EventPublisher outbox;

    DeviceAssignments(
            MissionRecords records,
            MissionLists lists,
            MissionOptions options,
            FarmContext farm,
            EventPublisher outbox) {
        this.records = records;
        this.lists = lists;
        this.options = options;
        this.farm = farm;
        this.outbox = outbox;
    }

    /** Begins to ask for all devices of a mission, or for none of them where one is another's. Answers how many there are. */
    int ask(Mission mission, long now) throws RejectedException {
        List<DesiredDevice> roster = roster(mission, now);
        Set<String> beingWritten = beingWrittenFor(mission);
        checkFree(mission, roster, beingWritten);
        checkRoom(roster, beingWritten);
        advance(mission, new Rollout(mission.mission(), Rollout.Kind.START, 0, now));
        return roster.size();
    }

    private void checkFree(Mission mission, List<DesiredDevice> roster, Set<String> beingWritten)
            throws RejectedException {
        Set<String> keys = new HashSet<>();
        for (DesiredDevice desired : roster) {
            String key = desired.version().key();
            String id = desired.version().id();
            DeviceState known = records.devices().get(key);
            boolean taken = known != null
                    && known.device().running()
                    && !known.mission().equals(mission.mission());
            if (taken) {
                throw new RejectedException(
                        ErrorCode.DEVICE_TAKEN,
                        "device '%s' is on mission '%s'; stop that first".formatted(id, known.mission()));
            }
            if (beingWritten.contains(key)) {
                throw new RejectedException(
                        ErrorCode.DEVICE_TAKEN, "device '%s' is on another mission; stop that first".formatted(id));
            }
            if (!keys.add(key)) {
                throw new RejectedException(
                        ErrorCode.DEVICE_TAKEN, "device '%s' is twice on the mission".formatted(id));
            }
        }
    }

    private void checkRoom(List<DesiredDevice> roster, Set<String> beingWritten) throws RejectedException {
        long fresh = roster.stream()
                .map(desired -> desired.version().key())
                .filter(key -> !records.devices().contains(key))
                .count();
        long unwritten = beingWritten.stream()
                .filter(key -> !records.devices().contains(key))
                .count();
        farm.quota().require((fresh + unwritten) * Limits.DEVICE_BYTES);
    }

    /** The devices of other missions that have begun to start, of which some are not written yet. */
    private Set<String> beingWrittenFor(Mission mission) {
        Set<String> keys = new HashSet<>();
        records.rollouts().forEach(rollout -> {
            if (rollout.kind() == Rollout.Kind.START && !rollout.mission().equals(mission.mission())) {
                Mission other = records.missions().get(rollout.mission());
                roster(other, 0).forEach(device -> keys.add(device.version().key()));
            }
        });
        return keys;
    }

    /**
     * Begins to want none of its devices any more. Their records stay, so that jobs know to whom their past belongs. Answers how
     * many are simulated and have to go: of a real device only the login ends.
     */
    int dismiss(Mission mission, long now) {
        int simulated = 0;
        for (DeviceState known : of(mission)) {
            simulated += known.device().running() && known.device().simulated() ? 1 : 0;
        }
        advance(mission, new Rollout(mission.mission(), Rollout.Kind.STOP, 0, now));
        return simulated;
    }

    /** Whether devices of a mission are still to be written. */
    boolean isBeingWritten(String mission) {
        return records.rollouts().get(mission) != null;
    }

    /** Writes the next devices of a rollout. Answers whether it is done. */
    boolean advance(Mission mission, Rollout rollout) {
        List<DesiredDevice> roster = roster(mission, rollout.time());
        int end = Math.min(roster.size(), rollout.next() + options.devicesPerStep());
        for (DesiredDevice desired : roster.subList(Math.min(rollout.next(), end), end)) {
            if (rollout.kind() == Rollout.Kind.START) {
                put(desired);
            } else {
                stop(mission, desired.version().key(), rollout.time());
            }
        }
        boolean done = end == roster.size();
        records.rollouts().put(mission.mission(), done ? null : rollout.at(end));
        return done;
    }

    private void stop(Mission mission, String key, long time) {
        DeviceState known = records.devices().get(key);
        if (known != null
                && known.mission().equals(mission.mission())
                && known.device().running()) {
            DeviceVersion version = known.device().version();
            put(known.device().with(version.endingAt(Math.max(time, version.from())), false));
        }
    }

    /**
     * Gives a device new credentials. It counts as up as before: whoever hosts it says whether it is with the new ones.
     *
     * @param id of its entity
     * @return how often that was done
     */
    int rotateCredentials(String id) throws RejectedException {
        DeviceState known = records.devices().get(options.scope().identity(id));
        if (known == null || known.forgotten()) {
            throw new RejectedException(ErrorCode.UNKNOWN_DEVICE, "there is no device '%s'".formatted(id));
        }
        if (known.device().device() == null) {
            throw new RejectedException(
                    ErrorCode.NO_CREDENTIALS,
                    "device '%s' has a login of its own, which is not known here; list it as an object with a 'type' to give it one"
                            .formatted(id));
        }
        DesiredDevice rotated = known.device().withGeneration(known.device().generation() + 1);
        String key = rotated.version().key();
        put(rotated);
        records.devices().put(key, records.devices().get(key).reported(known.confirmed(), known.reason()));
        return rotated.generation();
    }

    /** Forgets its devices, their past too. */
    void forget(Mission mission) {
        records.rollouts().put(mission.mission(), null);
        forget(mission, Set.of());
    }

    /**
     * Forgets the devices of a mission as it was, but not those that it has as it is now; of these it stops the ones that a stop has not
     * reached yet.
     */
    void forgetAllBut(List<DeviceState> before, Mission now) {
        Set<String> kept = new HashSet<>();
        roster(now, 0).forEach(device -> kept.add(device.version().key()));
        forget(before, kept);
        Rollout rollout = records.rollouts().get(now.mission());
        if (rollout != null && rollout.kind() == Rollout.Kind.STOP) {
            kept.forEach(key -> stop(now, key, rollout.time()));
            records.rollouts().put(now.mission(), null);
        }
    }

    private void forget(Mission mission, Set<String> kept) {
        forget(of(mission), kept);
    }

    private void forget(List<DeviceState> devices, Set<String> kept) {
        for (DeviceState known : devices) {
            String key = known.device().version().key();
            if (!kept.contains(key)) {
                // Else a device of the same name would let the stolen password in again.
                records.devices().put(key, known.generation() == 0 ? null : known.asForgotten());
                farm.quota().use(known.generation() == 0 ? -Limits.DEVICE_BYTES : 0);
                outbox.put(Topics.DEVICES, key, null);
            }
        }
    }

    /** Some of its devices that are not up, or, if it shall not run, that are still simulated, and why. */
    List<MissionStatus.Missing> missing(Mission mission) {
        return of(mission).stream()
                .filter(known -> !known.confirmed()
                        && (mission.running() || known.device().simulated()))
                .limit(MissionStatus.MAX_NAMED)
                .map(DeviceState::missing)
                .toList();
    }

    /** Those of its devices that are still its own. */
    List<DeviceState> of(Mission mission) {
        List<DeviceState> own = new ArrayList<>();
        for (DesiredDevice each : roster(mission, 0)) {
            DeviceState known = records.devices().get(each.version().key());
            if (known != null && !known.forgotten() && known.mission().equals(mission.mission())) {
                own.add(known);
            }
        }
        return own;
    }

    private List<DesiredDevice> roster(Mission mission, long from) {
        return PlannedDevices.of(mission, lists.groups(mission), options, from);
    }

    private void put(DesiredDevice device) {
        DeviceVersion version = device.version();
        DeviceState known = records.devices().get(version.key());
        DesiredDevice numbered = device.with(version.numbered(farm.sequence().next()), device.running())
                .withGeneration(Math.max(device.generation(), known == null ? 0 : known.generation()));
        if (known == null) {
            farm.quota().use(Limits.DEVICE_BYTES);
        }
        records.devices().put(version.key(), DeviceState.asked(numbered, known));
        outbox.put(Topics.DEVICES, version.key(), numbered.toBytes());
    }
}
