package io.furrow.simulators.device;

import java.io.IOException;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.Future;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.LongAdder;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The devices of a scenario at work: provisioned, connected and reporting until closed. Made for up to
 * {@value #MOST_CONNECTIONS} MQTT devices, each with a connection of its own.
 */
public final class Fleet implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Fleet.class);
    private static final int MOST_CONNECTIONS = 200;

    private final List<Device> devices = new ArrayList<>();
    private final ScheduledThreadPoolExecutor beats = new Beats();
    private final LongAdder reports = new LongAdder();
    private final Instant start = Instant.now();

    private Fleet() {}

    /**
     * Provisions the scenario's devices at the IoT Agent, connects them and lets them report.
     *
     * @throws IOException if the IoT Agent or the MQTT broker is away or refuses; nothing is left running then
     */
    public static Fleet start(FleetSettings settings, Scenario scenario) throws IOException, InterruptedException {
        List<Registration> registrations = registrations(scenario);
        if (registrations.size() > MOST_CONNECTIONS) {
            throw new IllegalArgumentException("the scenario has %d MQTT devices, a fleet at most %d"
                    .formatted(registrations.size(), MOST_CONNECTIONS));
        }
        new IotAgent(settings).provision(scenario.apiKey(), registrations);
        Fleet fleet = new Fleet();
        boolean started = false;
        try {
            fleet.join(settings, scenario);
            started = true;
            return fleet;
        } finally {
            if (!started) {
                fleet.close();
            }
        }
    }

    /** How many reports have been made since the start. */
    public long reports() {
        return reports.sum();
    }

    /** Stops all devices within seconds, also when the MQTT broker does not answer. */
    @Override
    public void close() {
        beats.shutdownNow();
        devices.parallelStream().forEach(Device::close);
        devices.clear();
    }

    private void join(FleetSettings settings, Scenario scenario) throws IOException {
        FiwareHttp http = new FiwareHttp(settings);
        for (Scenario.Assignment assignment : scenario.assignments()) {
            DevicePlan plan = assignment.device();
            Device device = plan instanceof DevicePlan.RobotPlan
                    ? new Robot(settings, http, assignment, start)
                    : MqttDevice.connect(
                            settings, "/" + scenario.apiKey() + "/" + plan.id(), sensor(plan), plan.route(), start);
            devices.add(device);
            long phase = devices.size() * 37L % plan.periodMs();
            beats.scheduleAtFixedRate(() -> report(device), phase, plan.periodMs(), TimeUnit.MILLISECONDS);
        }
    }

    private void report(Device device) {
        device.report(Instant.now());
        reports.increment();
    }

    private static List<Registration> registrations(Scenario scenario) {
        return scenario.assignments().stream()
                .filter(assignment -> !(assignment.device() instanceof DevicePlan.RobotPlan))
                .map(Fleet::registration)
                .toList();
    }

    private static Registration registration(Scenario.Assignment assignment) {
        Sensor sensor = sensor(assignment.device());
        return new Registration(
                assignment.device().id(),
                new Registration.Entity(assignment.device().entity(), sensor.entityType()),
                List.of(
                        sensor.attribute(),
                        new Registration.Attribute("stat", "Status", "Boolean"),
                        new Registration.Attribute("time", "Time", "Integer"),
                        new Registration.Attribute("lat", "Latitude", "Float"),
                        new Registration.Attribute("lon", "Longitude", "Float"),
                        new Registration.Attribute("where", "Location", "String")),
                new Registration.MissionOf(assignment.domain(), assignment.mission()),
                MqttDevice.COMMANDS);
    }

    private static Sensor sensor(DevicePlan plan) {
        if (plan instanceof DevicePlan.ThermometerPlan thermometer) {
            return Thermometer.of(thermometer);
        }
        return new Camera(plan.id());
    }

    /** One daemon thread; a report that fails by a fault of ours would end its series silently, so it is logged. */
    private static final class Beats extends ScheduledThreadPoolExecutor {
        Beats() {
            super(1, task -> {
                Thread thread = new Thread(task, "simulated-devices");
                thread.setDaemon(true);
                return thread;
            });
        }

        @Override
        protected void afterExecute(Runnable task, Throwable thrown) {
            super.afterExecute(task, thrown);
            if (task instanceof Future<?> future && future.isDone() && !future.isCancelled()) {
                try {
                    future.get();
                } catch (ExecutionException e) {
                    LOG.error("a simulated device broke down and reports no more", e.getCause());
                } catch (InterruptedException e) {
                    Thread.currentThread().interrupt();
                }
            }
        }
    }
}
