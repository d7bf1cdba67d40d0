package io.furrow.soak.devices;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.control.Until;

/**
 * Runs two hundred devices on a farm of processes: first undisturbed, then while agent, control plane and broker are
 * killed in turn.
 */
public final class RealDevices {
    private static final Duration OUTAGE = Duration.ofSeconds(8);
    private static final Duration TIMEOUT = Duration.ofMinutes(1);
    private static final Duration SETTLE_TIME = Duration.ofSeconds(10);
    /** Interval within which the stand-in writes its file. */
    private static final Duration STORE_INTERVAL = Duration.ofSeconds(8);

    private final Path home;
    private final Path folder;
    private final Duration undisturbed;
    private final ProgramPlan plan = new ProgramPlan();
    private final CheckResults checkResults = new CheckResults();
    private final RealFarm farm;
    private final Programs programs;
    private final LoginChecks logins;
    private final MeasureChecks measures;
    private final DeviceViews views;

    private RealDevices(Path home, Path folder, Duration undisturbed) throws IOException, InterruptedException {
        this.home = home;
        this.folder = folder;
        this.undisturbed = undisturbed;
        farm = new RealFarm(home, folder, plan);
        programs = new Programs(program(), folder.resolve("programs"));
        logins = new LoginChecks(farm, plan, programs, checkResults);
        measures = new MeasureChecks(farm.up.kafka(), plan, checkResults);
        views = new DeviceViews(farm.up, plan, checkResults);
    }

    private Path program() {
        return home.resolve("soak").resolve("parts").resolve("device_programs.py");
    }

    /** Arguments: the checkout, a folder for data and logs, seconds without disturbance. */
    public static void main(String... args) throws Exception {
        JavaProcess.killChildrenAtExit();
        RealDevices soak = new RealDevices(
                Path.of(args[0]).toAbsolutePath(),
                Path.of(args[1]).toAbsolutePath(),
                Duration.ofSeconds(Long.parseLong(args[2])));
        boolean holds = false;
        try {
            holds = soak.run();
        } finally {
            System.out.println();
            soak.checkResults.lines().forEach(System.out::println);
        }
        System.exit(holds ? 0 : 1);
    }

    private boolean run() throws Exception {
        print("Mosquitto, the stand-ins of Orion and IoT Agent, and ./furrow up start");
        farm.start();
        long startedAt = System.currentTimeMillis();
        startMissions(farm.up, programs, plan.missions());
        print("%d devices in %d processes".formatted(plan.devices().size(), programs.processes()));
        views.missions();
        undisturbed("undisturbed", startedAt);
        views.healthyDevices("undisturbed");
        views.faultsBesideMosquitto("undisturbed");
        logins.checkCommandLine(every(60));
        logins.checkCommands("undisturbed", commanded());
        logins.rotate(every(40));
        killEachOnce();
        undisturbed("after the kills", System.currentTimeMillis());
        views.healthyDevices("after the kills");
        views.noHealthyDeviceIsSilent(quiet());
        logins.checkCommands("to quiet devices", quiet());
        boolean alive = programs.areAlive();
        programs.close();
        farm.close();
        faultsAtTheSuitesOwnBroker();
        return checkResults.hold() && alive;
    }

    /** Checks the same faults with the suite's own broker and agent, which detect more of them. */
    private void faultsAtTheSuitesOwnBroker() throws Exception {
        print("./furrow up starts with its own broker and agent");
        try (UpProcess up = new UpProcess(home, folder.resolve("own"), List.of("--start-timeout", "20s"));
                Programs faulty = new Programs(program(), folder.resolve("own").resolve("programs"))) {
            up.start();
            startMissions(
                    up,
                    faulty,
                    plan.missions().stream()
                            .filter(mission -> mission.name().equals(ProgramPlan.FAULTY))
                            .toList());
            new DeviceViews(up, plan, checkResults).faultsOfTheSuite();
        }
    }

    private static void startMissions(UpProcess up, Programs programs, List<ProgramPlan.Mission> missions)
            throws Exception {
        up.run("domain", "create", ProgramPlan.DOMAIN);
        for (ProgramPlan.Mission mission : missions) {
            up.run(
                    "mission",
                    "start",
                    mission.name(),
                    "--domain",
                    ProgramPlan.DOMAIN,
                    "--devices",
                    mission.groups().toString());
        }
        for (ProgramPlan.Mission mission : missions) {
            programs.setCredentials(
                    mission.name(), up.run("device", "credentials", "--mission", mission.name(), "--output", "csv"));
            programs.start(mission);
        }
    }

    /** Waits, and compares the results of the period. */
    private void undisturbed(String when, long since) throws Exception {
        Thread.sleep(SETTLE_TIME.toMillis());
        long from = System.currentTimeMillis();
        Thread.sleep(undisturbed.toMillis());
        long to = System.currentTimeMillis();
        Thread.sleep(MeasureChecks.VISIBLE_AFTER.toMillis());
        List<ProgramEvent> events = programs.events();
        measures.checkArrivals(when, events, since, to, true);
        measures.checkAverages(when, events, from, to);
        measures.checkEncounters(when, events, from, to);
    }

    private void killEachOnce() throws Exception {
        Thread.sleep(STORE_INTERVAL.toMillis());
        Map<String, String> before = logins.connected();
        long killedAt = System.currentTimeMillis();
        print("kill -9 of context broker and IoT Agent");
        farm.standIn.kill();
        Thread.sleep(OUTAGE.toMillis());
        farm.standIn.start();
        checkRecovery("the agent's end", before, killedAt, false);

        killedAt = System.currentTimeMillis();
        print("kill -9 of ./furrow up, with control plane, Kafka, Connect and Flink");
        farm.up.kill();
        Thread.sleep(OUTAGE.toMillis());
        farm.up.start();
        checkRecovery("the control plane's end", before, killedAt, false);
        views.healthyDevices("after the control plane's end");
        views.faultsBesideMosquitto("after it");

        killedAt = System.currentTimeMillis();
        print("kill -9 of Mosquitto");
        long subscriptions = farm.agentSubscriptions();
        farm.mosquitto.kill();
        Thread.sleep(OUTAGE.toMillis());
        farm.mosquitto.start();
        Until.isTrue("the agent is back at Mosquitto", TIMEOUT, () -> farm.agentSubscriptions() > subscriptions);
        checkRecovery("the broker's end", before, killedAt, true);
    }

    private void checkRecovery(String after, Map<String, String> before, long since, boolean mayBeCut)
            throws Exception {
        logins.checkUnchanged(after, before, since, mayBeCut);
        long requested = System.currentTimeMillis();
        logins.checkCommands("after " + after, commanded());
        Thread.sleep(SETTLE_TIME.toMillis());
        measures.checkArrivals(
                "after " + after, programs.events(), requested, System.currentTimeMillis() - 5_000, false);
    }

    /** Devices with a period of 15 min that receive no command until the end. */
    private List<ProgramPlan.Device> quiet() {
        return plan.devices().stream()
                .filter(each -> each.mission().equals("quarter-hour"))
                .skip(15)
                .toList();
    }

    private List<ProgramPlan.Device> commanded() {
        List<ProgramPlan.Device> quiet = quiet();
        return plan.devices().stream()
                .filter(each -> each.reports() && !quiet.contains(each))
                .toList();
    }

    /** Every {@code count}-th device that can receive commands. */
    private List<ProgramPlan.Device> every(int count) {
        List<ProgramPlan.Device> all = commanded();
        return Stream.iterate(0, index -> index < all.size(), index -> index + count)
                .map(all::get)
                .toList();
    }

    private static void print(String arguments) {
        System.out.println(arguments);
    }
}
