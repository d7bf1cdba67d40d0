package io.furrow.simulators.wanted;

import java.util.HashMap;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.WantedDevice;

/**
 * Compares desired devices with running ones: determines the step for each record of {@code service.devices}, and the
 * status to publish on {@code service.devices.status}. Pure. A record whose sequence is not above the last one of its
 * device is skipped, so that reading the topic again changes nothing; a device whose step failed counts as stopped, and
 * the next sequence tries again.
 */
public final class DeviceReconciler {
    private final Map<String, Device> devices = new HashMap<>();

    /**
     * State of a device.
     *
     * @param asked the newest record, null if the device was deleted and has yet to be stopped
     * @param runs the running device of the key; null if none runs
     */
    private record Device(WantedDevice asked, long sequence, WantedDevice runs) {}

    /** A step for the host of the devices. */
    public sealed interface Step {
        String key();

        /** Starts a device. */
        record Start(String key, WantedDevice device) implements Step {}

        /** Replaces a running device by its new description. */
        record Replace(String key, WantedDevice before, WantedDevice device) implements Step {}

        /** Stops a device. */
        record Stop(String key, WantedDevice before) implements Step {}

        /** Only publishes the status: the device is already as desired. */
        record Confirm(String key) implements Step {}
    }

    /**
     * Processes a record.
     *
     * @param wanted null for a deletion
     * @return the step; empty if the record is out of date, or of a device that was never simulated here
     */
    public Optional<Step> take(String key, WantedDevice wanted) {
        Device known = devices.getOrDefault(key, new Device(null, -1, null));
        if (wanted == null) {
            devices.put(key, new Device(null, known.sequence, known.runs));
            if (known.runs == null) {
                devices.remove(key);
                return Optional.empty();
            }
            return Optional.of(new Step.Stop(key, known.runs));
        }
        if (wanted.version().sequence() <= known.sequence) {
            return Optional.empty();
        }
        if (!wanted.simulated() && known.asked == null) {
            return Optional.empty();
        }
        devices.put(key, new Device(wanted, wanted.version().sequence(), known.runs));
        return Optional.of(step(key, wanted, known.runs));
    }

    private static Step step(String key, WantedDevice wanted, WantedDevice runs) {
        boolean run = wanted.running() && wanted.simulated();
        if (runs == null) {
            return run ? new Step.Start(key, wanted) : new Step.Confirm(key);
        }
        if (!run) {
            return new Step.Stop(key, runs);
        }
        return alike(wanted, runs) ? new Step.Confirm(key) : new Step.Replace(key, runs, wanted);
    }

    /** Whether both describe the same running device, though they may differ in sequence or start. */
    private static boolean alike(WantedDevice a, WantedDevice b) {
        return a.type().equals(b.type())
                && a.device().equals(b.device())
                && Objects.equals(a.period(), b.period())
                && a.settings().equals(b.settings())
                && a.generation() == b.generation()
                && a.version().domain().equals(b.version().domain())
                && a.version().mission().equals(b.version().mission())
                && Objects.equals(a.version().carriedBy(), b.version().carriedBy());
    }

    /**
     * Records the outcome of a step.
     *
     * @param failure the reason as a sentence; null on success
     * @return the record for the status topic under the step's key; empty for a tombstone
     */
    public Optional<DeviceStatus> done(Step step, String failure) {
        Device known = devices.get(step.key());
        if (known.asked == null) {
            devices.remove(step.key());
            return Optional.empty();
        }
        WantedDevice runs = failure == null && known.asked.running() && known.asked.simulated() ? known.asked : null;
        devices.put(step.key(), new Device(known.asked, known.sequence, runs));
        DeviceStatus.State state = DeviceStatus.State.STOPPED;
        if (failure != null) {
            state = DeviceStatus.State.FAILED;
        } else if (runs != null) {
            state = DeviceStatus.State.RUNNING;
        }
        return Optional.of(new DeviceStatus(known.sequence, state, failure));
    }

    /** Number of running devices. */
    public long running() {
        return devices.values().stream().filter(device -> device.runs != null).count();
    }
}
