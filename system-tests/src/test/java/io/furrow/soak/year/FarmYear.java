package io.furrow.soak.year;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.mission.mongo.MissionCollections;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.Until;
import io.furrow.soak.devices.Verdicts;
import io.furrow.soak.year.Accounts.DayMission;

/** A farm's weeks, a day in ten seconds, each week with another end; and what the suite holds after each. */
public final class FarmYear {
    static final String DOMAIN = "year";

    private static final int DAYS_OF_A_WEEK = 7;
    private static final int WEEKS_OF_A_MONTH = 4;
    private static final int KEPT_DAYS = 7;
    private static final Duration DAY = Duration.ofSeconds(10);
    /** Until the jobs know a mission's devices. */
    private static final Duration KNOWN = Duration.ofSeconds(2);

    private static final Duration WORK = Duration.ofSeconds(5);
    private static final Duration TIMEOUT = Duration.ofMinutes(1);
    private static final Duration SETTLED = Duration.ofSeconds(12);
    private static final double MAX_GROWTH = 1.2;
    private static final double MAX_START_GROWTH = 1.5;
    private static final long SEED = 7;

    private final int weeks;
    private final Verdicts verdicts = new Verdicts();
    private final YearFarm farm;
    private final Fleet fleet;
    private final Accounts accounts;
    private final PowerCut power;
    private final Deque<String> kept = new ArrayDeque<>();
    private final Map<Integer, Map<String, Double>> footprints = new TreeMap<>();
    private List<DayMission> ofTheWeek = new ArrayList<>();
    private double startSeconds;

    private FarmYear(Path home, Path folder, int weeks) throws Exception {
        this.weeks = weeks;
        farm = new YearFarm(home, folder);
        fleet = new Fleet(farm.standIn().contextBroker());
        accounts = new Accounts(farm, fleet, verdicts);
        power = new PowerCut(farm.data().resolve("kafka"), folder.resolve("cut"), new Random(SEED));
    }

    /** Arguments: the checkout, a folder for data and logs, how many weeks. */
    public static void main(String... args) throws Exception {
        Runtime.getRuntime()
                .addShutdownHook(new Thread(
                        () -> ProcessHandle.current().descendants().forEach(ProcessHandle::destroyForcibly), "stop"));
        FarmYear year = new FarmYear(
                Path.of(args[0]).toAbsolutePath(), Path.of(args[1]).toAbsolutePath(), Integer.parseInt(args[2]));
        try {
            year.run();
        } finally {
            System.out.println();
            year.verdicts.lines().stream()
                    .filter(line -> !line.startsWith("holds"))
                    .forEach(System.out::println);
        }
        System.exit(year.verdicts.hold() ? 0 : 1);
    }

    private void run() throws Exception {
        say("Mosquitto, the stand-ins of Orion and IoT Agent, and ./furrow up start");
        start(farm::start);
        farm.up().run("domain", "create", DOMAIN);
        fleet.start();
        for (int week = 1; week <= weeks; week++) {
            for (int day = 1; day < DAYS_OF_A_WEEK; day++) {
                List<String> missions = begin(week, day);
                Thread.sleep(WORK.toMillis());
                end(missions, System.currentTimeMillis());
                Thread.sleep(DAY.minus(WORK).minus(KNOWN).toMillis());
            }
            endOfWeek(week);
        }
        fleet.close();
        compare();
        farm.close();
    }

    private static String name(int week, int day, int mission) {
        return "week-%d-day-%d-%d".formatted(week, day, mission);
    }

    private List<String> begin(int week, int day) throws InterruptedException {
        List<String> missions = new ArrayList<>();
        for (int mission = 0; mission < Fleet.MISSIONS; mission++) {
            String name = name(week, day, mission);
            ObjectNode plan = JsonNodeFactory.instance.objectNode().put("domain", DOMAIN);
            ArrayNode devices = plan.putArray("devices");
            Fleet.devices(mission).forEach(devices::add);
            ask("POST", "/api/missions/" + name + "/start", plan);
            missions.add(name);
        }
        Thread.sleep(KNOWN.toMillis());
        for (int mission = 0; mission < Fleet.MISSIONS; mission++) {
            ofTheWeek.add(new DayMission(
                    missions.get(mission),
                    new HashSet<>(Fleet.devices(mission)),
                    System.currentTimeMillis(),
                    Long.MAX_VALUE));
            fleet.begin(mission);
        }
        return missions;
    }

    /** @param until what was reported before belongs to them */
    private void end(List<String> missions, long until) throws InterruptedException, ExecutionException {
        for (int mission = 0; mission < Fleet.MISSIONS; mission++) {
            fleet.end(mission);
        }
        ofTheWeek.replaceAll(each -> each.ended() == Long.MAX_VALUE
                ? new DayMission(each.name(), each.devices(), each.begun(), until)
                : each);
        for (String name : missions) {
            ask("POST", "/api/missions/" + name + "/stop", null);
            kept.add(name);
        }
        while (kept.size() > KEPT_DAYS * Fleet.MISSIONS) {
            String old = kept.remove();
            ask("DELETE", "/api/missions/" + old, null);
            farm.forget(Topics.realtime(DOMAIN, old), MissionCollections.nameOf(old));
        }
    }

    /** In the middle of the last day's missions; these go on afterwards. */
    private void endOfWeek(int week) throws Exception {
        List<String> missions = begin(week, DAYS_OF_A_WEEK);
        Thread.sleep(WORK.toMillis() / 2);
        String end;
        if (week % WEEKS_OF_A_MONTH == 0) {
            power.copy();
            farm.up().kill();
            accounts.powerWasCut(System.currentTimeMillis());
            end = "power cut, %d partitions lost something".formatted(power.putBack());
        } else if (week % 2 == 0) {
            farm.up().kill();
            end = "kill -9";
        } else {
            farm.up().close();
            end = "restart";
        }
        start(farm.up()::start);
        Thread.sleep(WORK.toMillis());
        long until = System.currentTimeMillis();
        end(missions, until);
        Thread.sleep(SETTLED.toMillis());
        accounts.settle("week %d (%s)".formatted(week, end), ofTheWeek, until, end.equals("restart"));
        ofTheWeek = new ArrayList<>();
        Map<String, Double> footprint = Footprint.of(farm, startSeconds);
        footprints.put(week, footprint);
        say("week %d: %s".formatted(week, footprint));
        replay(name(week, 1, 0));
    }

    private void replay(String mission) {
        ask(
                "POST",
                "/api/replays",
                JsonNodeFactory.instance.objectNode().put("mission", mission).put("speed", 10));
    }

    private interface Start {
        void run() throws Exception;
    }

    private void start(Start start) throws Exception {
        long began = System.nanoTime();
        start.run();
        startSeconds = Math.round((System.nanoTime() - began) / 1e8) / 10.0;
    }

    /** Asks until it is granted: what it asks for is allowed, but perhaps not yet. */
    private void ask(String method, String path, ObjectNode body) {
        byte[] bytes = body == null ? null : NgsiJson.write(body);
        Until.isTrue(
                method + " " + path,
                TIMEOUT,
                () -> Http.send(method, farm.up().api(path), bytes).join().status() / 100 == 2);
    }

    /** The end with the fourth week. */
    private void compare() {
        if (weeks <= WEEKS_OF_A_MONTH) {
            return;
        }
        Map<String, Double> before = footprints.get(WEEKS_OF_A_MONTH);
        footprints.get(weeks).forEach((what, now) -> {
            double most = before.get(what) * (what.equals("start s") ? MAX_START_GROWTH : MAX_GROWTH);
            verdicts.add(
                    what + " at the end",
                    String.format(Locale.ROOT, "%.1f, after the fourth week %.1f", now, before.get(what)),
                    now <= most ? List.of() : List.of(String.format(Locale.ROOT, "more than %.1f", most)));
        });
    }

    private static void say(String words) {
        System.out.println(words);
    }
}
