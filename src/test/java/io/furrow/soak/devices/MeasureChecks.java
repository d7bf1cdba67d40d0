package io.furrow.soak.devices;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.TopicLog;

/** Compares what the programs sent with the records on Kafka's topics. */
record MeasureChecks(String kafka, ProgramPlan plan, CheckResults checkResults) {
    private static final Duration READ_TIME = Duration.ofMillis(200);
    /** Time after which a window is visible: the out-of-orderness and a commit of the job. */
    static final Duration VISIBLE_AFTER = Duration.ofSeconds(15);

    private static final ExpectedAverages AVERAGES = new ExpectedAverages(10_000);

    /**
     * Each measure sent in the period is on the topic of its mission, and on no other: once, or at least once if
     * devices received commands meanwhile, because the status of a command is an event that repeats the measures.
     */
    void checkArrivals(String when, List<ProgramEvent> events, long from, long to, boolean once)
            throws UnreadableException {
        List<String> differences = new ArrayList<>();
        int sent = 0;
        for (ProgramPlan.Mission mission : plan.missions()) {
            Map<String, Integer> found = arrivals(mission.name());
            Set<String> ids = new HashSet<>(
                    mission.devices().stream().map(ProgramPlan.Device::id).toList());
            found.keySet().stream()
                    .filter(each -> !ids.contains(device(each)))
                    .forEach(each -> differences.add("in mission %s: %s".formatted(mission.name(), each)));
            Set<String> reporting = new HashSet<>(mission.devices().stream()
                    .filter(ProgramPlan.Device::reports)
                    .map(ProgramPlan.Device::id)
                    .toList());
            for (ProgramEvent each : events) {
                if (each.is("sent") && each.at() >= from && each.at() < to && reporting.contains(each.device())) {
                    sent++;
                    int times = found.getOrDefault(measure(each.device(), each.time()), 0);
                    if (times == 0 || once && times > 1) {
                        differences.add("%d times on the topic of %s: %s"
                                .formatted(times, mission.name(), measure(each.device(), each.time())));
                    }
                }
            }
        }
        checkResults.add(
                "reports in their missions, " + when,
                "%d reports, each %s".formatted(sent, once ? "once" : "there"),
                differences);
    }

    /** How often each measure is on the topic of a mission. */
    private Map<String, Integer> arrivals(String mission) throws UnreadableException {
        Map<String, Integer> found = new HashMap<>();
        for (Entity each : read(Topics.realtime(ProgramPlan.DOMAIN, mission))) {
            each.number("Time").ifPresent(time -> found.merge(measure(each.id(), time.longValue()), 1, Integer::sum));
        }
        return found;
    }

    private static String measure(String device, long time) {
        return device + " at " + time;
    }

    private static String device(String measure) {
        return measure.substring(0, measure.indexOf(" at "));
    }

    void checkAverages(String when, List<ProgramEvent> events, long from, long to) throws UnreadableException {
        Map<String, String> fields = new HashMap<>();
        plan.devices().stream()
                .filter(each -> each.field() != null)
                .forEach(each -> fields.put(each.id(), each.field()));
        Set<String> late = late(Topics.TEMPERATURE_LATE);
        List<ProgramEvent> sent = inTime(events, late);
        Map<String, String> expected = AVERAGES.expected(sent, each -> fields.get(each.device()), from, to);
        Map<String, String> found = AVERAGES.found(read(Topics.TEMPERATURE), from, to);
        List<String> differences = new ArrayList<>();
        Set<String> windows = new TreeSet<>(expected.keySet());
        windows.addAll(found.keySet());
        for (String window : windows) {
            if (!String.valueOf(expected.get(window)).equals(found.get(window))) {
                differences.add("%s: %s instead of %s".formatted(window, found.get(window), expected.get(window)));
            }
        }
        long unexpected = unexpectedlyLate(events, late, from, to);
        checkResults.add(
                "averages of the fields, " + when,
                "%d windows; %d measures too late for theirs beside what was stored"
                        .formatted(expected.size(), unexpected),
                expected.isEmpty() ? List.of("there was no window") : differences);
    }

    void checkEncounters(String when, List<ProgramEvent> events, long from, long to) throws UnreadableException {
        Set<String> late = late(Topics.COLLISION_LATE);
        Set<String> tractors = new HashSet<>(plan.devices().stream()
                .filter(ProgramPlan.Device::isTractor)
                .map(ProgramPlan.Device::id)
                .toList());
        List<ProgramEvent> positions = inTime(events, late).stream()
                .filter(each -> tractors.contains(each.device()))
                .toList();
        Set<String> expected = ExpectedEncounters.expected(positions, from, to);
        List<Entity> results = read(Topics.COLLISION);
        Set<String> found = ExpectedEncounters.found(results, from, to);
        List<String> differences = new ArrayList<>();
        expected.stream().filter(each -> !found.contains(each)).forEach(each -> differences.add("missing: " + each));
        found.stream().filter(each -> !expected.contains(each)).forEach(each -> differences.add("too many: " + each));
        ExpectedEncounters.pairs(results).stream()
                .filter(each -> !plan.pairs().contains(each))
                .forEach(each -> differences.add("must not meet: " + each));
        checkResults.add(
                "encounters, " + when,
                "%d encounters of %d pairs, no other pair met"
                        .formatted(expected.size(), plan.pairs().size()),
                expected.isEmpty() ? List.of("there was no encounter") : differences);
    }

    private static List<ProgramEvent> inTime(List<ProgramEvent> events, Set<String> late) {
        return events.stream()
                .filter(each -> each.is("sent") && !late.contains(measure(each.device(), each.time())))
                .sorted(Comparator.comparingLong(ProgramEvent::time))
                .toList();
    }

    /** Counts late measures among those whose time is the time of sending. */
    private static long unexpectedlyLate(List<ProgramEvent> events, Set<String> late, long from, long to) {
        return events.stream()
                .filter(each -> each.is("sent") && each.time() >= from && each.time() < to)
                .filter(each -> Math.abs(each.at() - each.time()) < 1_000)
                .filter(each -> late.contains(measure(each.device(), each.time())))
                .count();
    }

    private Set<String> late(String topic) throws UnreadableException {
        Set<String> late = new HashSet<>();
        for (Entity each : read(topic)) {
            each.number("Time").ifPresent(time -> late.add(measure(each.id(), time.longValue())));
        }
        return late;
    }

    private List<Entity> read(String topic) throws UnreadableException {
        try (TopicLog log = new TopicLog(kafka, topic)) {
            return log.read(READ_TIME);
        }
    }
}
