package io.furrow.soak.control;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.BooleanSupplier;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.model.topic.Topics;

/**
 * Sends random requests to two control planes while these and their environment are killed, disconnected or blocked; in
 * the end all states must agree.
 */
public final class ControlChaos {
    private static final int MISSIONS = 8;
    private static final Duration STEP = Duration.ofMillis(300);
    private static final Duration REPORTS = Duration.ofSeconds(1);
    private static final Duration PROGRESS = Duration.ofMinutes(1);
    /** The retry interval of an unavailable webhook, five minutes, and the start of a mission after that. */
    private static final Duration SETTLE_TIMEOUT = Duration.ofMinutes(8);

    private final Settings settings;
    private final ChaosFarm farm;
    private final List<String> faults = new CopyOnWriteArrayList<>();
    private final List<Thread> threads = new ArrayList<>();
    private final List<MissionActor> missions = new ArrayList<>();
    private final Random random;
    private final RequestSender sender;
    private final AnswerLog answers;
    private final Requester requester;
    private final EncounterActor encounters;
    private final DeviceReports reports;
    private final ChaosChecks checks;
    private final Random silences;
    private volatile boolean requesting = true;
    private volatile boolean reporting = true;

    /**
     * Settings of a run.
     *
     * @param brief whether each outage is short and occurs once
     * @param seed of all random choices
     */
    record Settings(Path folder, Duration duration, boolean brief, long seed) {}

    private ControlChaos(Settings settings, ChaosFarm farm) {
        this.settings = settings;
        this.farm = farm;
        this.random = new Random(settings.seed());
        String bootstrapServers = farm.kafka.bootstrapServers();
        sender = new RequestSender(bootstrapServers);
        answers = new AnswerLog(bootstrapServers);
        requester = new Requester(
                sender, answers, farm.controls.stream().map(ControlProcess::api).toList());
        for (int i = 0; i < MISSIONS; i++) {
            Random own = new Random(random.nextLong());
            missions.add(new MissionActor("m" + i, "d" + i % 2, requester, own, faults));
        }
        encounters = new EncounterActor(sender, requester, farm.receiver, new Random(random.nextLong()));
        reports = new DeviceReports(sender, missions);
        silences = new Random(random.nextLong());
        checks = new ChaosChecks(farm, missions);
    }

    /** Arguments: folder, minutes, seed. */
    public static void main(String... args) throws Exception {
        Settings settings = new Settings(
                Path.of(args[0]), Duration.ofMinutes(Long.parseLong(args[1])), false, Long.parseLong(args[2]));
        JavaProcess.killChildrenAtExit();
        List<String> faults = run(settings);
        faults.forEach(System.out::println);
        System.exit(faults.isEmpty() ? 0 : 1);
    }

    /** Runs and returns the differences at the end as sentences; empty without differences. */
    static List<String> run(Settings settings) throws Exception {
        try (ChaosFarm farm = ChaosFarm.start(settings.folder())) {
            print("seed %d, %d s".formatted(settings.seed(), settings.duration().toSeconds()));
            ControlChaos chaos = new ControlChaos(settings, farm);
            try {
                return chaos.run();
            } finally {
                chaos.close();
            }
        }
    }

    private List<String> run() throws Exception {
        List<Supervisor> supervisors = farm.controls.stream()
                .map(control -> new Supervisor(control, faults))
                .toList();
        ChaosFaults outages = new ChaosFaults(farm, supervisors, settings.brief(), random);
        for (String domain : List.of("d0", "d1")) {
            requester.request(
                    new ControlRequest(
                            "domain-" + domain,
                            Topics.DOMAIN_MANAGER,
                            "create",
                            JsonNodeFactory.instance.objectNode().put("domain", domain)),
                    random);
        }
        RecoveryTime recovery = new RecoveryTime(outages::stopsServing, farm.controls);
        startActors();
        repeat("recovery", STEP, () -> reporting, () -> {
            recovery.step();
            return null;
        });
        outages.start();
        watch(outages);
        outages.stop();
        print("all servers run again after %s; %d requests are answered"
                .formatted(outages.counts(), requester.answered()));
        requesting = false;
        settle();
        supervisors.forEach(Supervisor::close);
        print(
                "%d requests, %d retries; %d encounters, %d alarms received; %d missions failed; %d starts without Kafka; longest recovery %.1f s"
                        .formatted(
                                requester.sent().size(),
                                requester.repeated(),
                                encounters.pairs().size(),
                                farm.receiver.count(),
                                missions.stream().mapToInt(MissionActor::failed).sum(),
                                supervisors.stream()
                                        .mapToInt(Supervisor::restarts)
                                        .sum(),
                                recovery.maxSeconds()));
        return List.copyOf(faults);
    }

    private void startActors() {
        missions.forEach(mission -> repeat(mission.mission(), STEP, () -> requesting, () -> {
            mission.step();
            return null;
        }));
        repeat("encounters", STEP, () -> requesting, () -> {
            encounters.step();
            return null;
        });
        repeat("silence", REPORTS, () -> requesting, () -> {
            silenceForAWhile();
            return null;
        });
        repeat("reports", REPORTS, () -> reporting, () -> {
            reports.step();
            return null;
        });
    }

    private void silenceForAWhile() throws InterruptedException {
        String mission = missions.get(silences.nextInt(missions.size())).mission();
        reports.silence(mission);
        for (int i = 5 + silences.nextInt(20); i > 0 && requesting; i--) {
            Thread.sleep(REPORTS.toMillis());
        }
        reports.resume(mission);
    }

    private void repeat(String name, Duration pause, BooleanSupplier condition, Callable<Void> step) {
        Thread thread = new Thread(
                () -> {
                    try {
                        while (condition.getAsBoolean()) {
                            step.call();
                            Thread.sleep(pause.toMillis());
                        }
                    } catch (InterruptedException e) {
                        Thread.currentThread().interrupt();
                    } catch (Exception e) { // a fault of the driver, which must not be overlooked
                        faults.add("the driver's " + name + " ended: " + e);
                    }
                },
                name);
        thread.setDaemon(true);
        threads.add(thread);
        thread.start();
    }

    private void watch(ChaosFaults outages) throws InterruptedException {
        long end = System.nanoTime() + settings.duration().toNanos();
        while (System.nanoTime() < end) {
            Thread.sleep(Math.max(1, Math.min(PROGRESS.toMillis(), (end - System.nanoTime()) / 1_000_000)));
            print("unavailable: %s; requests %d, answered %d, retries %d; encounters %d, alarms received %d; faults %d"
                    .formatted(
                            outages.unavailable(),
                            requester.sent().size(),
                            requester.answered(),
                            requester.repeated(),
                            encounters.pairs().size(),
                            farm.receiver.count(),
                            faults.size()));
        }
    }

    /** Waits until there are no differences; those that remain at the timeout are faults. */
    private void settle() throws Exception {
        long startedAt = System.nanoTime();
        for (Thread thread : threads) {
            if (!Set.of("reports", "recovery").contains(thread.getName())) {
                thread.join(SETTLE_TIMEOUT.toMillis());
                if (thread.isAlive()) {
                    faults.add("%s got no answer within %d s".formatted(thread.getName(), SETTLE_TIMEOUT.toSeconds()));
                    return;
                }
            }
        }
        print("all requests are answered %.1f s after everything was back"
                .formatted((System.nanoTime() - startedAt) / 1e9));
        Until.within(SETTLE_TIMEOUT, () -> differences(true).isEmpty());
        print("settled %.1f s after everything was back".formatted((System.nanoTime() - startedAt) / 1e9));
        reporting = false;
        faults.addAll(differences(false));
    }

    /** @param restart whether to restart missions that have failed meanwhile */
    private List<String> differences(boolean restart) {
        try {
            List<String> all = new ArrayList<>(checks.parts());
            if (restart && all.isEmpty()) {
                restartFailed();
            }
            all.addAll(checks.missions());
            if (!restart || all.isEmpty()) {
                all.addAll(checks.devices());
                all.addAll(checks.answers(requester, answers));
                all.addAll(checks.alarms(encounters.pairs()));
            }
            return all;
        } catch (Exception e) { // a check that fails counts as a difference
            return List.of(e.toString());
        }
    }

    private void restartFailed() throws InterruptedException {
        for (MissionActor mission : missions) {
            String path = "/api/missions/" + mission.mission();
            boolean failed = mission.isRunning()
                    && Http.get(farm.controls.get(0).api().resolve(path))
                            .body()
                            .at("/status/state")
                            .asText()
                            .equals("failed");
            if (failed) {
                print("mission %s failed and is started again".formatted(mission.mission()));
                mission.start(false);
            }
        }
    }

    private static void print(String text) {
        System.out.println(text);
    }

    private void close() {
        requesting = false;
        reporting = false;
        answers.close();
        sender.close();
    }
}
