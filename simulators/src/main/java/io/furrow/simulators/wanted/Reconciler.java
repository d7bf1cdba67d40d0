package io.furrow.simulators.wanted;

import java.util.HashMap;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.WantedDevice;

/**
 * Wanted devices against running ones: which step each record of {@code service.devices} asks for, and what is to be said of it on
 * {@code service.devices.status}. Pure. A record whose sequence is not above the last one of its device is passed over, so that
 * reading the topic again does nothing twice; a device whose step failed is as good as stopped, and the next sequence tries anew.
 */
public final class Reconciler {
    private final Map<String, Device> devices = new HashMap<>();

    /**
     * What is known of a device.
     *
     * @param asked the newest record, null where the device was deleted and has only to be stopped yet
     * @param runs what runs under its key; null where nothing does
     */
    private record Device(WantedDevice asked, long sequence, WantedDevice runs) {}

    /** What the host of the devices has to do. */
    public sealed interface Step {
        String key();

        /** Begins to run a device. */
        record Start(String key, WantedDevice device) implements Step {}

        /** Stops a device and begins to run it as it is wanted now. */
        record Replace(String key, WantedDevice before, WantedDevice device) implements Step {}

        /** Stops a device. */
        record Stop(String key, WantedDevice before) implements Step {}

        /** Nothing: it is as it is wanted already, and only that is to be said. */
        record Confirm(String key) implements Step {}
    }

    /**
     * Takes a record.
     *
     * @param wanted null for a deletion
     * @return what it asks for; nothing where it is out of date, or is of a device that nobody hosts
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
        if (!wanted.isHosted() && known.asked == null) {
            return Optional.empty();
        }
        devices.put(key, new Device(wanted, wanted.version().sequence(), known.runs));
        return Optional.of(step(key, wanted, known.runs));
    }

    private static Step step(String key, WantedDevice wanted, WantedDevice runs) {
        boolean run = wanted.running() && wanted.isHosted();
        if (runs == null) {
            return run ? new Step.Start(key, wanted) : new Step.Confirm(key);
        }
        if (!run) {
            return new Step.Stop(key, runs);
        }
        return alike(wanted, runs) ? new Step.Confirm(key) : new Step.Replace(key, runs, wanted);
    }

    /** Whether the same has to run for both, though they differ in sequence or in since when they hold. */
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
     * Remembers how a step went.
     *
     * @param failure why it failed, a sentence; null where it did not
     * @return the record for the status topic under the step's key; empty where that is to be deleted
     */
    public Optional<DeviceStatus> done(Step step, String failure) {
        Device known = devices.get(step.key());
        if (known.asked == null) {
            devices.remove(step.key());
            return Optional.empty();
        }
        WantedDevice runs = failure == null && known.asked.running() && known.asked.isHosted() ? known.asked : null;
        devices.put(step.key(), new Device(known.asked, known.sequence, runs));
        DeviceStatus.State state = DeviceStatus.State.STOPPED;
        if (failure != null) {
            state = DeviceStatus.State.FAILED;
        } else if (runs != null) {
            state = DeviceStatus.State.RUNNING;
        }
        return Optional.of(new DeviceStatus(known.sequence, state, failure));
    }

    /** How many devices run. */
    public long running() {
        return devices.values().stream().filter(device -> device.runs != null).count();
    }
}
