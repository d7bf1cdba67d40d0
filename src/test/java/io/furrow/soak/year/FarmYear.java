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
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.topic.Topics;
import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.devices.CheckResults;
import io.furrow.soak.year.Accounts.DayMission;
import io.furrow.soak.year.Accounts.Span;
import io.furrow.suite.page.OpeningTime;

/**
 * Simulates weeks of a farm with days of ten seconds; ends each week in another way, and checks all results after it.
 */
public final class FarmYear implements AutoCloseable {
    static final String DOMAIN = "year";

    private static final int DAYS_OF_A_WEEK = 7;
    private static final int WEEKS_OF_A_MONTH = 4;
    private static final int RETENTION_DAYS = 7;
    private static final int DAY_OF_REPLAY = 3;
    /** Time after which the jobs know a mission's devices. */
    private static final Duration START_DELAY = Duration.ofSeconds(2);

    private static final Duration SETTLE_TIMEOUT = Duration.ofSeconds(30);
    private static final Duration POLL_INTERVAL = Duration.ofSeconds(1);
    private static final double MAX_GROWTH = 1.2;
    private static final double MAX_START_GROWTH = 1.5;
    private static final int OPENINGS = 3;
    private static final long MAX_OPENING_MILLIS = 3_000;
    private static final long SEED = 7;

    private final int weeks;
    private final Duration day;
    private final CheckResults checkResults = new CheckResults();
    private final YearFarm farm;
    private final YearFleet fleet;
    private final Plots plots;
    private final Accounts accounts;
    private final YearResults results;
    private final SilentDevices silent;
    private final YearReplays replays;
    private final PowerCut power;
    private final Deque<String> storedMissions = new ArrayDeque<>();
    private final Map<Integer, Map<String, Double>> footprints = new TreeMap<>();
    private List<DayMission> weekMissions = new ArrayList<>();
    private long from = System.currentTimeMillis();
    private double startSeconds;

    /** @param furrow command that starts Furrow @param folder for data and logs */
    FarmYear(List<String> furrow, Path folder, int weeks, Duration day) throws Exception {
        this.weeks = weeks;
        this.day = day;
        farm = new YearFarm(furrow, folder);
        fleet = new YearFleet(farm.standIn.contextBroker());
        plots = new Plots(farm);
        accounts = new Accounts(farm);
        results = new YearResults(farm, fleet, plots, accounts);
        silent = new SilentDevices(farm, fleet);
        replays = new YearReplays(farm);
        power = new PowerCut(farm.data.resolve("kafka"), folder.resolve("cut"), new Random(SEED));
    }

    /** Arguments: the checkout, a folder for data and logs, number of weeks, seconds of a day. */
    public static void main(String... args) throws Exception {
        JavaProcess.killChildrenAtExit();
        FarmYear year = new FarmYear(
                List.of(Path.of(args[0]).toAbsolutePath().resolve("furrow").toString()),
                Path.of(args[1]).toAbsolutePath(),
                Integer.parseInt(args[2]),
                Duration.ofSeconds(Long.parseLong(args[3])));
        try (year) {
            year.run();
        } finally {
            System.out.println();
            year.differences().forEach(System.out::println);
        }
        System.exit(year.checkResults.hold() ? 0 : 1);
    }

    /** The checks that failed. */
    List<String> differences() {
        return checkResults.lines().stream()
                .filter(line -> !line.startsWith("holds"))
                .toList();
    }

    void run() throws Exception {
        print("Mosquitto, the stand-ins of Orion and IoT Agent, and ./furrow up start");
        start(farm::start);
        farm.request(
                "POST", "/api/domains", JsonNodeFactory.instance.objectNode().put("domain", DOMAIN));
        plots.start();
        fleet.start();
        for (int week = 1; week <= weeks; week++) {
            long startedAt = System.nanoTime();
            silent.begin(week);
            for (int number = 1; number < DAYS_OF_A_WEEK; number++) {
                long evening = System.nanoTime() + day.toNanos();
                day(week, number);
                Thread.sleep(Math.max(0, (evening - System.nanoTime()) / 1_000_000));
            }
            endOfWeek(week);
            farm.retain(Duration.ofNanos(System.nanoTime() - startedAt));
            print("week %d took %.1f s".formatted(week, (System.nanoTime() - startedAt) / 1e9));
        }
        fleet.close();
        compare();
    }

    private void day(int week, int number) throws Exception {
        plots.change(week, number);
        List<String> missions = begin(week, number);
        if (number == 1) {
            silent.report();
        } else if (number == DAY_OF_REPLAY) {
            replays.start(name(week, 1, 0));
        }
        Thread.sleep(day.toMillis() / 2);
        if (number == DAYS_OF_A_WEEK - 1) {
            add(silent.checkSilent("week " + week, week));
            add(replays.playedAndDeleted("week " + week));
            openPage(week);
        }
        end(missions, System.currentTimeMillis());
    }

    private static String name(int week, int day, int mission) {
        return "week-%d-day-%d-%d".formatted(week, day, mission);
    }

    private List<String> begin(int week, int day) throws InterruptedException {
        List<String> missions = new ArrayList<>();
        for (int mission = 0; mission < YearFleet.MISSIONS; mission++) {
            String name = name(week, day, mission);
            ObjectNode plan = JsonNodeFactory.instance.objectNode().put("domain", DOMAIN);
            ArrayNode devices = plan.putArray("devices");
            YearFleet.devices(mission).forEach(devices::add);
            farm.request("POST", "/api/missions/" + name + "/start", plan);
            missions.add(name);
        }
        Thread.sleep(START_DELAY.toMillis());
        for (int mission = 0; mission < YearFleet.MISSIONS; mission++) {
            weekMissions.add(new DayMission(
                    missions.get(mission),
                    new HashSet<>(YearFleet.devices(mission)),
                    System.currentTimeMillis(),
                    Long.MAX_VALUE));
            fleet.begin(mission);
        }
        return missions;
    }

    /** @param until earlier reports belong to the missions */
    private void end(List<String> missions, long until) {
        for (int mission = 0; mission < YearFleet.MISSIONS; mission++) {
            fleet.end(mission);
        }
        weekMissions.replaceAll(each -> each.ended() == Long.MAX_VALUE
                ? new DayMission(each.name(), each.devices(), each.begun(), until)
                : each);
        for (String name : missions) {
            farm.request("POST", "/api/missions/" + name + "/stop", null);
            storedMissions.add(name);
        }
        while (storedMissions.size() > RETENTION_DAYS * YearFleet.MISSIONS) {
            farm.delete(storedMissions.remove());
        }
    }

    /** Ends the week during the last day's missions, which continue afterwards. */
    private void endOfWeek(int week) throws Exception {
        List<String> missions = begin(week, DAYS_OF_A_WEEK);
        Thread.sleep(day.toMillis() / 4);
        fleet.awaitParted();
        String end;
        if (week % WEEKS_OF_A_MONTH == 0) {
            power.copy();
            farm.up.kill();
            accounts.addPowerCut(System.currentTimeMillis());
            end = "power cut, %d partitions lost something".formatted(power.restoreCopies());
        } else if (week % 2 == 0) {
            farm.up.kill();
            end = "kill -9";
        } else {
            farm.up.close();
            end = "restart";
        }
        start(farm.up::start);
        String when = "week %d (%s)".formatted(week, end);
        add(silent.checkSilent("after the end of " + when, week));
        silent.end(week);
        Thread.sleep(day.toMillis() / 2);
        long until = System.currentTimeMillis();
        end(missions, until);
        settle(new Span(when, from, until, end.equals("restart")));
        add(silent.checkRemoved(when, week));
        silent.delete(week);
        from = until;
        footprints.put(week, Footprint.of(farm, startSeconds));
        print("week %d: %s".formatted(week, footprints.get(week)));
    }

    /** Repeats the checks until they succeed or the timeout passes. */
    private void settle(Span span) throws Exception {
        long end = System.nanoTime() + SETTLE_TIMEOUT.toNanos();
        List<YearCheck> checks = checks(span);
        while (!checks.stream().allMatch(YearCheck::holds) && System.nanoTime() < end) {
            Thread.sleep(POLL_INTERVAL.toMillis());
            checks = checks(span);
        }
        checks.forEach(this::add);
        accounts.drop(span.until());
        weekMissions = new ArrayList<>();
    }

    private List<YearCheck> checks(Span span) throws Exception {
        List<YearCheck> checks = new ArrayList<>(accounts.check(span, weekMissions));
        checks.add(results.encounters(span));
        checks.add(results.averages(span));
        checks.add(plots.check(span.when()));
        return checks;
    }

    private void add(YearCheck check) {
        checkResults.add(check.what(), check.figures(), check.differences());
    }

    /** Measures the opening of the page in the fourth and the last week, while missions run. */
    private void openPage(int week) {
        if (week != WEEKS_OF_A_MONTH && week != weeks) {
            return;
        }
        List<String> devices = YearFleet.devices();
        // the compilers of a JVM that was started minutes ago delay one opening more than another
        List<Long> millis = Stream.generate(() -> OpeningTime.millis(farm.up.dashboard(), devices))
                .limit(OPENINGS)
                .sorted()
                .toList();
        checkResults.add(
                "the page opens, week " + week,
                "%s ms until %d devices are on map and cards".formatted(millis, devices.size()),
                millis.get(OPENINGS / 2) <= MAX_OPENING_MILLIS
                        ? List.of()
                        : List.of("the median is more than " + MAX_OPENING_MILLIS + " ms"));
    }

    private interface Start {
        void run() throws Exception;
    }

    private void start(Start start) throws Exception {
        long startedAt = System.nanoTime();
        start.run();
        startSeconds = Math.round((System.nanoTime() - startedAt) / 1e8) / 10.0;
    }

    /** Checks that retention deleted records, and compares the last week with the fourth. */
    private void compare() {
        if (weeks < WEEKS_OF_A_MONTH) {
            return;
        }
        try (ReportLog log = new ReportLog(farm.up.kafka())) {
            long removed = log.removed(Topics.RAW);
            checkResults.add(
                    "retention",
                    removed + " records of data.raw removed",
                    removed > 0 ? List.of() : List.of("nothing was removed"));
        }
        if (weeks == WEEKS_OF_A_MONTH) {
            return;
        }
        Map<String, Double> reference = footprints.get(WEEKS_OF_A_MONTH);
        footprints.get(weeks).forEach((what, now) -> {
            double max = reference.get(what) * (what.equals("start s") ? MAX_START_GROWTH : MAX_GROWTH);
            checkResults.add(
                    what + " at the end",
                    String.format(Locale.ROOT, "%.1f, after the fourth week %.1f", now, reference.get(what)),
                    now <= max ? List.of() : List.of(String.format(Locale.ROOT, "more than %.1f", max)));
        });
    }

    private static void print(String text) {
        System.out.println(text);
    }

    @Override
    public void close() {
        fleet.close();
        farm.close();
    }
}
