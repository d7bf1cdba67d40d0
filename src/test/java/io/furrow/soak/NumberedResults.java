package io.furrow.soak;

import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Compares all results of the jobs with those expected from {@link NumberedEvents}: none missing, none repeated. */
public final class NumberedResults {
    private static final Duration TIMEOUT = Duration.ofSeconds(60);
    /** Long enough for a repetition that is still being processed. */
    private static final Duration READ_TIME = Duration.ofSeconds(3);
    /** The jobs' out-of-orderness and one report of each device: later results need not exist yet. */
    private static final long OPEN_MILLIS = 2_500;

    private static final int MAX_SHOWN = 10;

    /** Topics that {@code flink-run} names. */
    private static final String NORMALIZED = "data.raw.native";

    private static final String GREEN = "data.temperature.green";
    private static final String WIDE = "data.collision.wide";
    private static final double DEFAULT_THRESHOLD_METERS = 5;
    private static final double WIDE_THRESHOLD_METERS = 8;
    /** The fields of the devices in {@code fields.geojson}, at all positions of the second robot. */
    private static final Map<String, List<String>> FIELDS_OF = Map.of(
            SoakFarm.FIRST_THERMOMETER, List.of("farm"),
            SoakFarm.SECOND_THERMOMETER, List.of("farm", "corner"),
            SoakFarm.FIRST_ROBOT, List.of("farm"),
            SoakFarm.SECOND_ROBOT, List.of("farm"));

    private final Expected expected;
    private final String bootstrapServers;
    private final long windowMillis;

    private NumberedResults(String bootstrapServers, long windowMillis) throws UnreadableException {
        this.bootstrapServers = bootstrapServers;
        this.windowMillis = windowMillis;
        try (TopicLog raw = new TopicLog(bootstrapServers, Topics.RAW)) {
            expected = new Expected(raw.read(READ_TIME));
        }
    }

    /**
     * Arguments: bootstrap servers, window of the temperature job in ms. The exit code is 0 if there is no difference.
     */
    public static void main(String... args) throws UnreadableException {
        System.exit(new NumberedResults(args[0], Long.parseLong(args[1])).isClean() ? 0 : 1);
    }

    private boolean isClean() throws UnreadableException {
        Map<String, ResultComparison> comparisons = new LinkedHashMap<>();
        for (String topic : List.of(
                Topics.realtime(SoakFarm.DOMAIN), Topics.realtime(SoakFarm.DOMAIN, SoakFarm.MISSION), NORMALIZED)) {
            try (TopicLog log = new TopicLog(bootstrapServers, topic)) {
                comparisons.put(topic, compare(log, expected.numbers(), Long.MAX_VALUE));
                System.out.printf("%-32s nothing for %.1f s at most%n", topic, log.maxSilence() / 1000.0);
            }
        }
        for (Map.Entry<String, List<Result>> topic : results().entrySet()) {
            try (TopicLog log = new TopicLog(bootstrapServers, topic.getKey())) {
                comparisons.put(topic.getKey(), compare(log, topic.getValue(), expected.lastTime() - OPEN_MILLIS));
            }
        }
        long deadOrLate = TopicLog.count(bootstrapServers, List.of(".dead", ".late"));
        comparisons.forEach(NumberedResults::print);
        System.out.printf("%-32s %5d records%n", "late and dead", deadOrLate);
        return deadOrLate == 0 && comparisons.values().stream().allMatch(ResultComparison::isClean);
    }

    /** The expected results of each topic; blue and green jobs have the same results, another threshold has others. */
    private Map<String, List<Result>> results() {
        Map<String, List<Result>> results = new LinkedHashMap<>();
        results.put(Topics.TEMPERATURE, windows());
        results.put(GREEN, windows());
        results.put(Topics.COLLISION, expected.encounters(DEFAULT_THRESHOLD_METERS));
        results.put(WIDE, expected.encounters(WIDE_THRESHOLD_METERS));
        results.put(Topics.PRESENCE, expected.entries(FIELDS_OF));
        return results;
    }

    private List<Result> windows() {
        List<String> both = List.of(SoakFarm.FIRST_THERMOMETER, SoakFarm.SECOND_THERMOMETER);
        List<Result> all = new ArrayList<>(expected.windows("farm", both, windowMillis));
        all.addAll(expected.windows("corner", List.of(SoakFarm.SECOND_THERMOMETER), windowMillis));
        return all;
    }

    /** Reads until nothing is missing, then once more to detect late repetitions. */
    private static ResultComparison compare(TopicLog log, List<Result> expected, long horizon)
            throws UnreadableException {
        long deadline = System.nanoTime() + TIMEOUT.toNanos();
        ResultComparison comparison;
        do {
            comparison = ResultComparison.of(expected, results(log.read(READ_TIME)), horizon);
        } while (!comparison.missing().isEmpty() && System.nanoTime() < deadline);
        return ResultComparison.of(expected, results(log.read(READ_TIME)), horizon);
    }

    private static List<Result> results(List<Entity> entities) {
        return entities.stream().map(NumberedResults::result).toList();
    }

    private static Result result(Entity entity) {
        return switch (entity.type()) {
            case "Analytics:FieldTemperature" ->
                Expected.window(
                        entity.text("field").orElseThrow(),
                        integer(entity, "windowEnd"),
                        entity.number("averageTemperature").orElseThrow(),
                        integer(entity, "devices"));
            case "Analytics:Collision" ->
                Expected.encounter(
                        entity.text("phase").orElseThrow(),
                        integer(entity, "time"),
                        entity.number("distance").orElseThrow());
            case "Analytics:Presence" ->
                Expected.passage(
                        entity.text("phase").orElseThrow(),
                        entity.text("device").orElseThrow(),
                        entity.text("field").orElseThrow(),
                        integer(entity, "time"));
            default -> Expected.numbered(entity);
        };
    }

    private static long integer(Entity entity, String attribute) {
        return entity.number(attribute).orElseThrow().longValue();
    }

    private static void print(String topic, ResultComparison comparison) {
        System.out.printf("%-32s %s%n", topic, comparison);
        Stream.of(
                        comparison.missing().stream().map(name -> "missing: " + name),
                        comparison.repeated().stream().map(name -> "repeated: " + name),
                        comparison.wrong().stream().map(name -> "wrong: " + name))
                .flatMap(lines -> lines.limit(MAX_SHOWN))
                .forEach(line -> System.out.println("    " + line));
    }
}
