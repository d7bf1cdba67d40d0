package io.furrow.analytics.collision;

import java.nio.file.Path;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.Map;

import picocli.CommandLine.Option;

import io.furrow.analytics.collision.rules.CellRules;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.DebounceRules;
import io.furrow.analytics.collision.rules.ExclusionZones;
import io.furrow.analytics.collision.rules.PositionRules;
import io.furrow.analytics.collision.rules.Thresholds;
import io.furrow.analytics.collision.rules.ZoneFile;

/** The options of {@link CollisionRules}. An accessor rejects an invalid value, with its argument's name. */
final class RuleOptions {
    @Option(
            names = "--threshold",
            paramLabel = "METERS",
            defaultValue = "5",
            description = "Two devices are close up to this distance, 0.1 to 100000 m. Default: ${DEFAULT-VALUE}.")
    private double threshold;

    @Option(
            names = "--threshold-of",
            paramLabel = "TYPE[+TYPE]=METERS",
            hideParamSyntax = true,
            description =
                    "Another threshold for devices of an entity type, or for pairs of two types; may be repeated. For "
                            + "any other pair the greater threshold of both types counts.")
    private Map<String, Double> thresholdOf = new LinkedHashMap<>();

    @Option(
            names = "--time-to-live",
            paramLabel = "DURATION",
            defaultValue = "30s",
            description =
                    "How long a position counts when no newer one comes. At least twice the interval between two reports "
                            + "of a device; otherwise encounters are split. Default: ${DEFAULT-VALUE}.")
    private Duration timeToLive;

    @Option(
            names = "--max-skew",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description =
                    "Positions further apart in time are not compared; 0s compares all. Set it if devices move far "
                            + "between two reports. Default: ${DEFAULT-VALUE}.")
    private Duration maxSkew;

    @Option(
            names = "--zones",
            paramLabel = "FILE",
            description =
                    "GeoJSON FeatureCollection of areas, such as yards, in which devices are not compared; the border "
                            + "belongs to them. Default: none.")
    private Path zones;

    @Option(
            names = "--leave-factor",
            paramLabel = "FACTOR",
            defaultValue = "1",
            description =
                    "An encounter lasts until the distance exceeds this many thresholds, 1 to 100. Use more than 1 if "
                            + "devices work side by side at about the threshold. Default: ${DEFAULT-VALUE}.")
    private double leaveFactor;

    @Option(
            names = "--dwell",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description = "Only an encounter that lasts longer than this is reported, from then on. Default: "
                    + "${DEFAULT-VALUE}.")
    private Duration dwell;

    @Option(
            names = "--ongoing-every",
            paramLabel = "DURATION",
            defaultValue = "1s",
            description = "Minimum event time between two records of an ongoing encounter; starts and ends are always "
                    + "reported. 0s reports every observation. Default: ${DEFAULT-VALUE}.")
    private Duration ongoingEvery;

    @Option(
            names = "--cell",
            paramLabel = "METERS",
            description =
                    "Height of a grid cell, at least the greatest threshold times --leave-factor. Affects only speed, "
                            + "and which pairs of a crowd beyond the nearest are tracked: smaller if devices are dense, larger if "
                            + "they are sparse. Default: 20 times the greatest threshold.")
    private Double cell;

    @Option(
            names = "--crowd",
            paramLabel = "N",
            defaultValue = "" + CellRules.CROWD,
            description =
                    "A device with more than N others close to it is in a crowd: only its nearest N * N / others are "
                            + "tracked, and --overflow-output reports it. 0 tracks all; the cost of devices in one spot then grows "
                            + "with the square of their number. Default: ${DEFAULT-VALUE}.")
    private int crowd;

    /** @throws IllegalArgumentException if the rules are invalid; the message names the mistake */
    CollisionRules rules() {
        Thresholds thresholds = new Thresholds(threshold, thresholdOf);
        DebounceRules steadiness = new DebounceRules(leaveFactor, dwell);
        ExclusionZones places = zones == null ? ExclusionZones.NONE : ZoneFile.read(zones);
        double reach = thresholds.greatest() * leaveFactor;
        return new CollisionRules(
                thresholds,
                new PositionRules(timeToLive, maxSkew, places),
                steadiness,
                ongoingEvery,
                new CellRules(cell == null ? CellRules.THRESHOLDS * reach : cell, crowd));
    }
}
