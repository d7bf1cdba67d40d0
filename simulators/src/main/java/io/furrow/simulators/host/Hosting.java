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

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.fleet.FarmFleet;
import io.furrow.simulators.robot.WorkField;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.UnusableScenarioException;
import io.furrow.simulators.scenario.WantedDeviceReader;
import io.furrow.simulators.wanted.Reconciler;
import io.furrow.simulators.wanted.Reconciler.Step;

/**
 * Brings a fleet in line with what is wanted. A device that cannot be made is tried again when a field or a robot comes that it may
 * have lacked. One thread uses it.
 */
final class Hosting {
    private static final Logger LOG = LoggerFactory.getLogger(Hosting.class);
    private static final String ROBOT = "Robot";

    private final Fleet fleet;
    private final StatusBoard board;
    private final long seed;
    private final Reconciler reconciler = new Reconciler();
    private final Map<String, WantedDevice> wanted = new HashMap<>();
    private final Map<String, Step> stuck = new LinkedHashMap<>();
    private final MissionDeviceLists lists = new MissionDeviceLists();
    /** Devices whose settings are not known yet: the record with them is on its way. */
    private final Map<String, WantedDevice> unresolved = new LinkedHashMap<>();

    private WantedDeviceReader reader;

    /** What runs devices. */
    interface Fleet {
        void add(Collection<FarmFleet.Member> members);

        void remove(String device);
    }

    Hosting(Fleet fleet, StatusBoard board, long seed) {
        this.fleet = fleet;
        this.board = board;
        this.seed = seed;
        this.reader = new WantedDeviceReader(Map.of(), seed);
    }

    /** The fields are these from now on; what runs stays as it is. */
    void know(Map<String, WorkField> fields) {
        reader = new WantedDeviceReader(fields, seed);
        start(retried());
    }

    /** Takes records of {@code service.missions.devices}, null for a part that was deleted. */
    void takeLists(Map<String, byte[]> records) {
        records.forEach(lists::take);
        Map<String, WantedDevice> waiting = new LinkedHashMap<>(unresolved);
        unresolved.clear();
        take(waiting);
    }

    /** Takes records of {@code service.devices}, the newest of each key, null for a device that was deleted. */
    void take(Map<String, WantedDevice> records) {
        Map<String, WantedDevice> resolved = new LinkedHashMap<>();
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

    private Optional<WantedDevice> resolve(WantedDevice device) {
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

    private void takeResolved(Map<String, WantedDevice> records) {
        List<Step> starts = new ArrayList<>();
        boolean robots = false;
        for (Map.Entry<String, WantedDevice> each : records.entrySet()) {
            String key = each.getKey();
            WantedDevice device = each.getValue();
            stuck.remove(key);
            if (device == null) {
                wanted.remove(key);
            } else {
                wanted.put(key, device);
                robots |= ROBOT.equals(device.type());
            }
            Step step = reconciler.take(key, device).orElse(null);
            if (step == null && device == null) {
                board.ended(key, null);
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

    /** Takes away what the step ends, or only says what it asks to be said. */
    private void end(Step step) {
        if (step instanceof Step.Replace replace) {
            fleet.remove(replace.before().device());
        } else if (step instanceof Step.Stop stop) {
            fleet.remove(stop.before().device());
            board.ended(step.key(), reconciler.done(step, null).orElse(null));
        } else if (step instanceof Step.Confirm) {
            DeviceStatus status = reconciler.done(step, null).orElse(null);
            if (status != null && status.state() == DeviceStatus.State.RUNNING) {
                board.confirmed(step.key(), status);
            } else {
                board.ended(step.key(), status);
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
            WantedDevice device = wanted.get(step.key());
            try {
                FarmFleet.Member member = member(step.key(), device);
                DeviceStatus running = reconciler.done(step, null).orElseThrow();
                board.begun(step.key(), device.device(), running);
                missions.computeIfAbsent(device.version().mission(), none -> new ArrayList<>())
                        .add(member);
            } catch (UnusableScenarioException e) {
                failed(step, device, e.getMessage());
            } catch (RuntimeException e) { // geometry that nobody foresaw, for instance; the others shall run
                LOG.warn("device {} cannot be simulated", device.device(), e);
                failed(step, device, "it cannot be simulated: " + e);
            }
        });
        missions.values().forEach(fleet::add);
    }

    private void failed(Step step, WantedDevice device, String reason) {
        stuck.put(step.key(), new Step.Start(step.key(), device));
        board.ended(step.key(), reconciler.done(step, reason).orElseThrow());
    }

    private FarmFleet.Member member(String key, WantedDevice device) throws UnusableScenarioException {
        DeviceVersion version = device.version();
        FiwareScope scope = new FiwareScope(version.service(), version.servicePath());
        SimulatedDevice simulated = reader.read(device);
        String taken = board.keyOf(device.device()).orElse(key);
        if (!taken.equals(key)) {
            throw new UnusableScenarioException(
                    "device", "'%s' runs here already, for %s".formatted(device.device(), taken));
        }
        if (version.carriedBy() != null) {
            WantedDevice carrier = wanted.get(scope.identity(version.carriedBy()));
            if (carrier == null || !ROBOT.equals(carrier.type()) || !carrier.running()) {
                throw new UnusableScenarioException(
                        "carriedBy", "'%s' is no robot that runs here".formatted(version.carriedBy()));
            }
        }
        return new FarmFleet.Member(simulated, scope, Instant.ofEpochMilli(version.from()));
    }

    /** Takes back what was said of devices that are no longer on the topic. */
    void forgetAllBut(Set<String> said) {
        said.stream()
                .filter(key -> !wanted.containsKey(key) && !unresolved.containsKey(key))
                .forEach(key -> board.ended(key, null));
    }
}
