package io.furrow.simulators.host;

import java.time.Instant;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Consumer;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.simulators.desired.DeviceReconciler;
import io.furrow.simulators.desired.DeviceReconciler.Step;
import io.furrow.simulators.fleet.FarmFleet;
import io.furrow.simulators.robot.WorkField;
import io.furrow.simulators.scenario.DesiredDeviceReader;
import io.furrow.simulators.scenario.InvalidScenarioException;
import io.furrow.simulators.scenario.SimulatedDevice;

/**
 * Reconciles a fleet with the desired devices. A device that cannot be created is retried when a field or robot appears
 * that it may lack. Used by one thread.
 */
final class FleetReconciler {
    private static final Logger LOG = LoggerFactory.getLogger(FleetReconciler.class);

    private final Consumer<Collection<FarmFleet.Member>> add;
    private final Consumer<String> remove;
    private final StatusPublisher statusPublisher;
    private final long seed;
    private final DeviceReconciler reconciler = new DeviceReconciler();
    private final Map<String, DesiredDevice> desired = new HashMap<>();
    private final Map<String, Step> stuck = new LinkedHashMap<>();
    private final MissionDeviceLists lists = new MissionDeviceLists();
    /** Devices whose settings are missing, because their record has not arrived yet. */
    private final Map<String, DesiredDevice> unresolved = new LinkedHashMap<>();

    private DesiredDeviceReader reader;

    /**
     * @param add adds devices of one mission to the fleet
     * @param remove removes a device from it
     */
    FleetReconciler(
            Consumer<Collection<FarmFleet.Member>> add,
            Consumer<String> remove,
            StatusPublisher statusPublisher,
            long seed) {
        this.add = add;
        this.remove = remove;
        this.statusPublisher = statusPublisher;
        this.seed = seed;
        this.reader = new DesiredDeviceReader(Map.of(), seed);
    }

    /** Changes the fields for new devices; running ones stay as they are. */
    void update(Map<String, WorkField> fields) {
        reader = new DesiredDeviceReader(fields, seed);
        start(retried());
    }

    /** Processes records of {@code service.missions.devices}, null for a deleted part. */
    void takeLists(Map<String, byte[]> records) {
        records.forEach(lists::take);
        Map<String, DesiredDevice> waiting = new LinkedHashMap<>(unresolved);
        unresolved.clear();
        take(waiting);
    }

    /** Processes the newest records of {@code service.devices} by key, null for a deleted device. */
    void take(Map<String, DesiredDevice> records) {
        Map<String, DesiredDevice> resolved = new LinkedHashMap<>();
        records.forEach((key, device) -> {
            unresolved.remove(key);
            if (device == null || !device.running()) {
                resolved.put(key, device);
            } else {
                resolve(device)
                        .ifPresentOrElse(complete -> resolved.put(key, complete), () -> unresolved.put(key, device));
            }
        });
        takeResolved(resolved);
    }

    private Optional<DesiredDevice> resolve(DesiredDevice device) {
        try {
            return lists.resolve(device);
        } catch (UnreadableException e) {
            LOG.warn(
                    "the device list of mission {} cannot be read: {}",
                    device.version().mission(),
                    e.getMessage());
            return Optional.empty();
        }
    }

    private void takeResolved(Map<String, DesiredDevice> records) {
        List<Step> starts = new ArrayList<>();
        boolean robots = false;
        for (Map.Entry<String, DesiredDevice> each : records.entrySet()) {
            String key = each.getKey();
            DesiredDevice device = each.getValue();
            stuck.remove(key);
            if (device == null) {
                desired.remove(key);
            } else {
                desired.put(key, device);
                robots |= device.isRobot();
            }
            Step step = reconciler.take(key, device).orElse(null);
            if (step == null && device == null) {
                statusPublisher.ended(key, null);
            } else if (step != null) {
                end(step);
                if (step instanceof Step.Start || step instanceof Step.Replace) {
                    starts.add(step);
                }
            }
        }
        if (robots) {
            starts.addAll(retried());
        }
        start(starts);
    }

    /** Executes the stopping part of a step, and publishes the status. */
    private void end(Step step) {
        if (step instanceof Step.Replace replace) {
            remove.accept(replace.before().device());
        } else if (step instanceof Step.Stop stop) {
            remove.accept(stop.before().device());
            statusPublisher.ended(step.key(), reconciler.done(step, null).orElse(null));
        } else if (step instanceof Step.Confirm) {
            DeviceStatus status = reconciler.done(step, null).orElse(null);
            if (status != null && status.state() == DeviceStatus.State.RUNNING) {
                statusPublisher.confirmed(step.key(), status);
            } else {
                statusPublisher.ended(step.key(), status);
            }
        }
    }

    private List<Step> retried() {
        List<Step> again = List.copyOf(stuck.values());
        stuck.clear();
        return again;
    }

    /** Starts devices, those of one mission together. */
    private void start(List<Step> steps) {
        Map<String, List<FarmFleet.Member>> missions = new LinkedHashMap<>();
        steps.stream().sorted(Comparator.comparing(Step::key)).forEach(step -> {
            DesiredDevice device = desired.get(step.key());
            try {
                FarmFleet.Member member = member(step.key(), device);
                DeviceStatus running = reconciler.done(step, null).orElseThrow();
                statusPublisher.begun(step.key(), device.device(), running);
                missions.computeIfAbsent(device.version().mission(), none -> new ArrayList<>())
                        .add(member);
            } catch (InvalidScenarioException e) {
                failed(step, device, e.getMessage());
            } catch (RuntimeException e) { // such as unforeseen geometry; other devices shall run
                LOG.warn("device {} cannot be simulated", device.device(), e);
                failed(step, device, "it cannot be simulated: " + FailureText.of(e));
            }
        });
        missions.values().forEach(add);
    }

    private void failed(Step step, DesiredDevice device, String reason) {
        stuck.put(step.key(), new Step.Start(step.key(), device));
        statusPublisher.ended(step.key(), reconciler.done(step, reason).orElseThrow());
    }

    private FarmFleet.Member member(String key, DesiredDevice device) throws InvalidScenarioException {
        DeviceVersion version = device.version();
        FiwareScope scope = new FiwareScope(version.service(), version.servicePath());
        SimulatedDevice simulated = reader.read(device);
        String taken = statusPublisher.keyOf(device.device()).orElse(key);
        if (!taken.equals(key)) {
            throw new InvalidScenarioException(
                    "device", "'%s' runs here already, for %s".formatted(device.device(), taken));
        }
        if (version.carriedBy() != null) {
            DesiredDevice carrier = desired.get(scope.identity(version.carriedBy()));
            if (carrier == null || !carrier.isRobot() || !carrier.running()) {
                throw new InvalidScenarioException(
                        "carriedBy", "'%s' is not a robot that runs here".formatted(version.carriedBy()));
            }
        }
        return new FarmFleet.Member(simulated, scope, Instant.ofEpochMilli(version.from()));
    }

    /** Deletes statuses of devices that are no longer on the topic. */
    void forgetAllBut(Set<String> reported) {
        reported.stream()
                .filter(key -> !desired.containsKey(key) && !unresolved.containsKey(key))
                .forEach(key -> statusPublisher.ended(key, null));
    }
}
