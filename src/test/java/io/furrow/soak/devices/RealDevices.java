package io.furrow.soak.devices;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.control.Until;

/** Two hundred devices on a farm of processes: first undisturbed, then while agent, control plane and broker are killed in turn. */
public final class RealDevices {
    private static final Duration UNAVAILABLE = Duration.ofSeconds(8);
    private static final Duration TIMEOUT = Duration.ofMinutes(1);
    private static final Duration SETTLED = Duration.ofSeconds(10);
    /** The stand-in writes its file so often at least. */
    private static final Duration STORED = Duration.ofSeconds(8);

    private final Path home;
    private final Path folder;
    private final Duration undisturbed;
    private final ProgramPlan plan = new ProgramPlan();
    private final CheckResults verdicts = new CheckResults();
    private final RealFarm farm;
    private final Programs programs;
    private final LoginChecks logins;
    private final MeasureChecks measures;
    private final DeviceViews shown;

    private RealDevices(Path home, Path folder, Duration undisturbed) throws IOException, InterruptedException {
        this.home = home;
        this.folder = folder;
        this.undisturbed = undisturbed;
        farm = new RealFarm(home, folder, plan);
        programs = new Programs(program(), folder.resolve("programs"));
        logins = new LoginChecks(farm, plan, programs, verdicts);
        measures = new MeasureChecks(farm.up.kafka(), plan, verdicts);
        shown = new DeviceViews(farm.up, plan, verdicts);
    }

    private Path program() {
        return home.resolve("soak").resolve("parts").resolve("device_programs.py");
    }

    /** Arguments: the checkout, a folder for data and logs, for how many seconds nothing is disturbed. */
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
            soak.verdicts.lines().forEach(System.out::println);
        }
        System.exit(holds ? 0 : 1);
    }

    private boolean run() throws Exception {
        print("Mosquitto, the stand-ins of Orion and IoT Agent, and ./furrow up start");
        farm.start();
        long began = System.currentTimeMillis();
        startMissions(farm.up, programs, plan.missions());
        print("%d devices in %d processes".formatted(plan.devices().size(), programs.processes()));
        shown.missions();
        undisturbed("undisturbed", began);
        shown.soundDevices("undisturbed");
        shown.faultsBesideMosquitto("undisturbed");
        logins.obey(every(60));
        logins.answer("undisturbed", commanded());
        logins.rotate(every(40));
        killEachOnce();
        undisturbed("after all came back", System.currentTimeMillis());
        shown.soundDevices("after all came back");
        shown.nobodyIsSilent(quiet());
        logins.answer("to those that said nothing", quiet());
        boolean alive = programs.areAlive();
        programs.close();
        farm.close();
        faultsAtTheSuitesOwnBroker();
        return verdicts.hold() && alive;
    }

    /** The same faults where broker and agent are the suite's own, which know more of them. */
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
            new DeviceViews(up, plan, verdicts).faultsOfTheSuite();
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
            programs.bring(
                    mission.name(), up.run("device", "credentials", "--mission", mission.name(), "--output", "csv"));
            programs.start(mission);
        }
    }

    /** Lets time pass, and compares what came of it. */
    private void undisturbed(String when, long since) throws Exception {
        Thread.sleep(SETTLED.toMillis());
        long from = System.currentTimeMillis();
        Thread.sleep(undisturbed.toMillis());
        long to = System.currentTimeMillis();
        Thread.sleep(MeasureChecks.VISIBLE_AFTER.toMillis());
        List<ProgramEvent> events = programs.events();
        measures.arrived(when, events, since, to, true);
        measures.averages(when, events, from, to);
        measures.encounters(when, events, from, to);
    }

    private void killEachOnce() throws Exception {
        Thread.sleep(STORED.toMillis());
        Map<String, String> before = logins.connected();
        long killed = System.currentTimeMillis();
        print("kill -9 of context broker and IoT Agent");
        farm.standIn.kill();
        Thread.sleep(UNAVAILABLE.toMillis());
        farm.standIn.start();
        isBack("the agent's end", before, killed, false);

        killed = System.currentTimeMillis();
        print("kill -9 of ./furrow up, with control plane, Kafka, Connect and Flink");
        farm.up.kill();
        Thread.sleep(UNAVAILABLE.toMillis());
        farm.up.start();
        isBack("the control plane's end", before, killed, false);
        shown.soundDevices("after the control plane's end");
        shown.faultsBesideMosquitto("after it");

        killed = System.currentTimeMillis();
        print("kill -9 of Mosquitto");
        long subscriptions = farm.agentSubscriptions();
        farm.mosquitto.kill();
        Thread.sleep(UNAVAILABLE.toMillis());
        farm.mosquitto.start();
        Until.isTrue("the agent is back at Mosquitto", TIMEOUT, () -> farm.agentSubscriptions() > subscriptions);
        isBack("the broker's end", before, killed, true);
    }

    private void isBack(String after, Map<String, String> before, long since, boolean mayBeCut) throws Exception {
        logins.remain(after, before, since, mayBeCut);
        long requested = System.currentTimeMillis();
        logins.answer("after " + after, commanded());
        Thread.sleep(SETTLED.toMillis());
        measures.arrived("after " + after, programs.events(), requested, System.currentTimeMillis() - 5_000, false);
    }

    /** Devices with a period of 15 min that are not sent anything until the end. */
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

    /** The first of so many that can be commanded. */
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
