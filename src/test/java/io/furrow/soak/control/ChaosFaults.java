package io.furrow.soak.control;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.Collectors;

/** Schedules the outages of a run: of which server, how often and how long. */
final class ChaosFaults {
    private final ChaosFarm farm;
    private final List<Supervisor> supervisors;
    private final List<RecurringFault> faults = new ArrayList<>();

    /** @param brief whether each outage is short and occurs once */
    ChaosFaults(ChaosFarm farm, List<Supervisor> supervisors, boolean brief, Random random) {
        this.farm = farm;
        this.supervisors = supervisors;
        int times = brief ? 1 : 0;
        for (int i = 0; i < supervisors.size(); i++) {
            String name = farm.controls.get(i).name();
            add(name, timing(brief, i == 0 ? 6 : 20, 3, 90, 15, times), control(supervisors.get(i)), random);
        }
        add("kafka", timing(brief, 13, 3, 300, 25, times), kafka(), random);
        add("iot-agent", timing(brief, 5, 8, 120, 40, times), proxy(farm.iotAgent), random);
        add("context-broker", timing(brief, 5, 8, 120, 40, times), proxy(farm.contextBroker), random);
        add("mosquitto", timing(brief, 9, 4, 150, 20, times), mosquitto(), random);
        add("webhook", timing(brief, 8, 6, 90, 30, times), proxy(farm.webhook), random);
        add("webhook-errors", timing(brief, 18, 4, 120, 20, times), webhookErrors(), random);
    }

    /** @param pause mean seconds of the brief form, like {@code outage}; the others are those of the long form */
    private static RecurringFault.Timing timing(
            boolean brief, int pause, int outage, int longPause, int longOutage, int times) {
        return new RecurringFault.Timing(
                Duration.ofSeconds(brief ? pause : longPause), Duration.ofSeconds(brief ? outage : longOutage), times);
    }

    private void add(String name, RecurringFault.Timing timing, RecurringFault.Action action, Random random) {
        faults.add(new RecurringFault(name, timing, action, new Random(random.nextLong())));
    }

    void start() {
        faults.forEach(RecurringFault::start);
    }

    /** Returns once everything works again. */
    void stop() throws InterruptedException {
        for (RecurringFault fault : faults) {
            fault.stop();
        }
    }

    /** The current outages. */
    String unavailable() {
        String unavailable = faults.stream()
                .filter(RecurringFault::isActive)
                .map(RecurringFault::name)
                .collect(Collectors.joining(", "));
        return unavailable.isEmpty() ? "nothing" : unavailable;
    }

    /** Whether Kafka or a control plane is unavailable, so that not all requests can be served. */
    boolean stopsServing() {
        return faults.stream()
                .filter(fault -> fault.name().equals("kafka") || fault.name().startsWith("control-"))
                .anyMatch(RecurringFault::isActive);
    }

    /** The number of outages of each kind. */
    String counts() {
        return faults.stream().map(fault -> fault.name() + " " + fault.count()).collect(Collectors.joining(", "));
    }

    private static RecurringFault.Action control(Supervisor supervisor) {
        return new RecurringFault.Action() {
            @Override
            public void begin(Random random) throws Exception {
                supervisor.kill();
            }

            @Override
            public void end() throws Exception {
                supervisor.start();
            }
        };
    }

    private RecurringFault.Action kafka() {
        return new RecurringFault.Action() {
            @Override
            public void begin(Random random) throws Exception {
                supervisors.forEach(Supervisor::noteKafkaOutage);
                farm.kafka.kill();
            }

            @Override
            public void end() throws Exception {
                farm.kafka.start();
                supervisors.forEach(Supervisor::noteKafkaOutage);
            }
        };
    }

    private RecurringFault.Action mosquitto() {
        return new RecurringFault.Action() {
            @Override
            public void begin(Random random) throws Exception {
                farm.mosquitto.kill();
            }

            @Override
            public void end() throws Exception {
                farm.mosquitto.start();
            }
        };
    }

    private RecurringFault.Action webhookErrors() {
        return new RecurringFault.Action() {
            @Override
            public void begin(Random random) {
                farm.receiver.setUnavailable(true);
            }

            @Override
            public void end() {
                farm.receiver.setUnavailable(false);
            }
        };
    }

    private static RecurringFault.Action proxy(FaultProxy proxy) {
        return new RecurringFault.Action() {
            @Override
            public void begin(Random random) throws Exception {
                proxy.setMode(random.nextBoolean() ? FaultProxy.Mode.HANG : FaultProxy.Mode.REFUSE);
            }

            @Override
            public void end() throws Exception {
                proxy.setMode(FaultProxy.Mode.PASS);
            }
        };
    }
}
