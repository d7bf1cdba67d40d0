package io.furrow.simulators.desired;

import java.util.HashMap;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;

/**
 * Compares desired devices with running ones: determines the step for each record of {@code service.devices}, and the
 * status to publish on {@code service.devices.status}. Pure. A record whose sequence is not above the last one of its
 * device is skipped, so that reading the topic again changes nothing; a device whose step failed counts as stopped, and
 * the next sequence tries again.
 */
public final class DeviceReconciler {
    private final Map<String, RunningDevice> devices = new HashMap<>();

    /**
     * State of a device.
     *
     * @param requested the newest record, null if the device was deleted and has yet to be stopped
     * @param runs the running device of the key; null if none runs
     */
    private record RunningDevice(DesiredDevice requested, long sequence, DesiredDevice runs) {}

    /** A step for the host of the devices. */
    public sealed interface Step {
        String key();

        /** Starts a device. */
        record Start(String key, DesiredDevice device) implements Step {}

        /** Replaces a running device by its new description. */
        record Replace(String key, DesiredDevice before, DesiredDevice device) implements Step {}

        /** Stops a device. */
        record Stop(String key, DesiredDevice before) implements Step {}

        /** Only publishes the status: the device is already as desired. */
        record Confirm(String key) implements Step {}
    }

    /**
     * Processes a record.
     *
     * @param desired null for a deletion
     * @return the step; empty if the record is out of date, or of a device that was never simulated here
     */
    public Optional<Step> take(String key, DesiredDevice desired) {
        RunningDevice existing = devices.getOrDefault(key, new RunningDevice(null, -1, null));
        if (desired == null) {
            devices.put(key, new RunningDevice(null, existing.sequence, existing.runs));
            if (existing.runs == null) {
                devices.remove(key);
                return Optional.empty();
            }
            return Optional.of(new Step.Stop(key, existing.runs));
        }
        if (desired.version().sequence() <= existing.sequence) {
            return Optional.empty();
        }
        if (!desired.simulated() && existing.requested == null) {
            return Optional.empty();
        }
        devices.put(key, new RunningDevice(desired, desired.version().sequence(), existing.runs));
        return Optional.of(step(key, desired, existing.runs));
    }

    private static Step step(String key, DesiredDevice desired, DesiredDevice runs) {
        boolean run = desired.running() && desired.simulated();
        if (runs == null) {
            return run ? new Step.Start(key, desired) : new Step.Confirm(key);
        }
        if (!run) {
            return new Step.Stop(key, runs);
        }
        return alike(desired, runs) ? new Step.Confirm(key) : new Step.Replace(key, runs, desired);
    }

    /** Whether both describe the same running device, though they may differ in sequence or start. */
    private static boolean alike(DesiredDevice a, DesiredDevice b) {
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
        RunningDevice existing = devices.get(step.key());
        if (existing.requested == null) {
            devices.remove(step.key());
            return Optional.empty();
        }
        DesiredDevice runs = failure == null && existing.requested.running() && existing.requested.simulated()
                ? existing.requested
                : null;
        devices.put(step.key(), new RunningDevice(existing.requested, existing.sequence, runs));
        DeviceStatus.State state = DeviceStatus.State.STOPPED;
        if (failure != null) {
            state = DeviceStatus.State.FAILED;
        } else if (runs != null) {
            state = DeviceStatus.State.RUNNING;
        }
        return Optional.of(new DeviceStatus(existing.sequence, state, failure));
    }

    /** Number of running devices. */
    public long running() {
        return devices.values().stream().filter(device -> device.runs != null).count();
    }
}
