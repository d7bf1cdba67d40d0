package io.furrow.soak.year;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.TopicLog;
import io.furrow.soak.devices.ExpectedAverages;
import io.furrow.soak.devices.ExpectedEncounters;
import io.furrow.soak.devices.ProgramEvent;
import io.furrow.soak.year.Accounts.Span;
import io.furrow.soak.year.Tap.Report;

/** Compares encounters and averages with those computed from the stored reports by their definitions. */
final class YearResults {
    static final Duration WINDOW = Duration.ofSeconds(2);

    /** Time from a reading until its average is written: its window, the jobs' out-of-orderness, a checkpoint. */
    private static final long UNTIL_WRITTEN_MILLIS = 5_000;

    private static final Duration READ_TIME = Duration.ofMillis(100);

    private final YearFarm farm;
    private final YearFleet fleet;
    private final Plots plots;
    private final Accounts accounts;
    private final ExpectedAverages averages = new ExpectedAverages(WINDOW.toMillis());

    YearResults(YearFarm farm, YearFleet fleet, Plots plots, Accounts accounts) {
        this.farm = farm;
        this.fleet = fleet;
        this.plots = plots;
        this.accounts = accounts;
    }

    YearCheck encounters(Span span) throws UnreadableException {
        long until = span.until() - Accounts.UNSYNCED_MILLIS;
        Set<Report> late = late(Topics.COLLISION_LATE);
        Set<String> expected = ExpectedEncounters.expected(
                stored(fleet.tractors()).stream()
                        .filter(each -> !late.contains(report(each)))
                        .toList(),
                span.from(),
                until);
        Set<String> found = ExpectedEncounters.found(read(Topics.COLLISION), span.from(), until);
        Set<String> differences = new TreeSet<>();
        expected.stream().filter(each -> !found.contains(each)).forEach(each -> differences.add("missing: " + each));
        found.stream().filter(each -> !expected.contains(each)).forEach(each -> differences.add("too many: " + each));
        if (expected.isEmpty()) {
            differences.add("there was no encounter");
        }
        return new YearCheck("encounters, " + span.when(), expected.size() + " encounters", List.copyOf(differences));
    }

    /**
     * A repeated reading may have been counted although a repetition is late. Unless each result must be there once,
     * results may be repeated unchanged.
     */
    YearCheck averages(Span span) throws UnreadableException {
        Set<Report> late = late(Topics.TEMPERATURE_LATE);
        List<ProgramEvent> readings = stored(fleet.thermometers());
        Map<JsonNode, Entity> results = new LinkedHashMap<>();
        List<Entity> all = read(Topics.TEMPERATURE);
        all.forEach(each -> results.putIfAbsent(each.json(), each));
        Map<String, String> found = averages.found(span.once() ? all : results.values(), span.from(), span.until());
        Map<String, String> expected = expected(
                readings.stream().filter(each -> !late.contains(report(each))).toList(), span);
        Map<String, String> withRepeated = expected(
                readings.stream()
                        .filter(each -> !late.contains(report(each)) || accounts.isRepeated(report(each)))
                        .toList(),
                span);
        withRepeated.forEach((window, value) -> {
            if (value.equals(found.get(window))) {
                expected.put(window, value);
            }
        });
        Set<String> cut = averages.expected(
                        readings.stream()
                                .filter(each -> accounts.isBeforeCut(
                                        each.time(), UNTIL_WRITTEN_MILLIS + Accounts.UNSYNCED_MILLIS))
                                .toList(),
                        plots::fieldOf,
                        span.from(),
                        span.until())
                .keySet();
        cut.forEach(expected::remove);
        cut.forEach(found::remove);
        List<String> differences = new ArrayList<>(YearCheck.differences(expected, found));
        if (expected.isEmpty()) {
            differences.add("there was no window");
        }
        return new YearCheck(
                "averages of the fields, " + span.when(),
                "%d windows of %d fields; %d around a power cut are left out, %d readings were late"
                        .formatted(
                                expected.size(),
                                expected.keySet().stream()
                                        .map(each -> each.split(" ")[0])
                                        .distinct()
                                        .count(),
                                cut.size(),
                                late.stream()
                                        .filter(each -> each.time() >= span.from())
                                        .count()),
                differences);
    }

    private Map<String, String> expected(List<ProgramEvent> readings, Span span) {
        return new TreeMap<>(averages.expected(readings, plots::fieldOf, span.from(), span.until()));
    }

    private List<ProgramEvent> stored(Map<Report, ProgramEvent> reported) {
        return reported.entrySet().stream()
                .filter(each -> accounts.isStored(each.getKey()))
                .map(Map.Entry::getValue)
                .sorted(Comparator.comparingLong(ProgramEvent::time))
                .toList();
    }

    private static Report report(ProgramEvent event) {
        return new Report(event.device(), event.time());
    }

    private Set<Report> late(String topic) throws UnreadableException {
        Set<Report> late = new HashSet<>();
        read(topic).forEach(each -> late.add(Report.of(each.json())));
        return late;
    }

    private List<Entity> read(String topic) throws UnreadableException {
        try (TopicLog log = new TopicLog(farm.up.kafka(), topic)) {
            return log.read(READ_TIME);
        }
    }
}
