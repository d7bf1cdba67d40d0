package io.furrow.analytics.collision;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.GeometryFactory;

import io.furrow.analytics.Seeds;
import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.rules.CellRules;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.DebounceRules;
import io.furrow.analytics.collision.rules.ExclusionZones;
import io.furrow.analytics.collision.rules.PositionRules;
import io.furrow.analytics.collision.rules.Thresholds;
import io.furrow.analytics.position.PositionFix;

/** Made-up farms: a handful of devices that wander about a place, with silences, repetitions and shared instants. */
public final class Worlds {
    public static final double[] THRESHOLDS = {0.5, 5, 50, 1000};

    private static final long STEP = 100;
    private static final int STEPS = 200;
    private static final int SILENCE = 70;

    private final Random random;

    public Worlds(long seed) {
        random = Seeds.random(seed);
    }

    /** Time-to-live 3 s, an ongoing record every 500 ms, sometimes a greatest skew. */
    public static CollisionRules rules(double threshold, double cellsPerThreshold, boolean skewed) {
        Duration skew = skewed ? Duration.ofMillis(700) : Duration.ZERO;
        return new CollisionRules(
                threshold, Duration.ofSeconds(3), skew, Duration.ofMillis(500), threshold * cellsPerThreshold);
    }

    /** Rules of any kind; the same for the same seed. */
    public static CollisionRules anyRules(double threshold, long seed) {
        Random random = Seeds.random(seed);
        double factor = random.nextInt(3) == 0 ? 1 + random.nextDouble() : 1;
        long dwell = random.nextInt(3) == 0 ? random.nextLong(2000) : 0;
        Thresholds thresholds = random.nextBoolean()
                ? Thresholds.of(threshold)
                : new Thresholds(
                        threshold,
                        Map.of(
                                "T0", threshold * (0.3 + random.nextDouble()),
                                "T2+T1", threshold * (0.3 + 2 * random.nextDouble())));
        Duration skew = random.nextInt(4) == 0 ? Duration.ofMillis(700) : Duration.ZERO;
        ExclusionZones zones = random.nextInt(3) == 0 ? yards(threshold, random) : ExclusionZones.NONE;
        int crowd = random.nextBoolean() ? CellRules.CROWD : random.nextInt(4);
        double reach = thresholds.greatest() * factor;
        return new CollisionRules(
                thresholds,
                new PositionRules(Duration.ofSeconds(3), skew, zones),
                new DebounceRules(factor, Duration.ofMillis(dwell)),
                Duration.ofMillis(500),
                new CellRules(reach * (1 + random.nextInt(30)), crowd));
    }

    /** A rectangle beside each center, some thresholds wide. */
    private static ExclusionZones yards(double threshold, Random random) {
        double degrees = Math.toDegrees(threshold * 3 / Geodesy.EARTH_RADIUS_METERS);
        List<Geometry> yards = new ArrayList<>();
        for (int i = 0; i < 6; i++) {
            double[] centre = centre(i);
            double width = Math.abs(centre[0]) == 90 ? 120 : degrees;
            double west = centre[1] - width * random.nextDouble();
            double south = centre[0] - degrees * random.nextDouble();
            Envelope yard = new Envelope(west, west + width, south, south + degrees);
            yards.add(new GeometryFactory().toGeometry(yard.intersection(new Envelope(-180, 180, -90, 90))));
        }
        return new ExclusionZones(yards);
    }

    /** Where grids go wrong, and one place where they do not: latitude and longitude. */
    public static double[] centre(int which) {
        return switch (which % 6) {
            case 0 -> new double[] {40.3125, -3.4821};
            case 1 -> new double[] {0, 0};
            case 2 -> new double[] {52.1, 180};
            case 3 -> new double[] {90, 0};
            case 4 -> new double[] {-90, 0};
            default -> new double[] {0.00001, -180};
        };
    }

    /** The positions of one world, 20 s from the start on, in no order. */
    public List<PositionFix> wander(double[] centre, double threshold, long start) {
        List<PositionFix> fixes = new ArrayList<>();
        int devices = 2 + random.nextInt(6);
        double room = threshold * (1 + 2 * random.nextDouble());
        for (int device = 0; device < devices; device++) {
            // Two tenants may know different devices by one id.
            String id = "urn:ngsi-ld:Robot:" + random.nextInt(devices);
            String identity = "farm" + device + "|/|" + id;
            String type = "T" + random.nextInt(3);
            String carrier = device > 0 && random.nextInt(6) == 0 ? fixes.get(0).identity() : "";
            double east = room * random.nextGaussian();
            double north = room * random.nextGaussian();
            int step = random.nextInt(30);
            while (step < STEPS) {
                double[] place = place(centre, east, north);
                long time = start + step * STEP;
                PositionFix fix = Fixes.of(identity, id, "m" + random.nextInt(2), place[0], place[1], time);
                fixes.add(Fixes.ofType(type, Fixes.carriedByIdentity(carrier, fix)));
                boolean stays = random.nextInt(4) == 0;
                east += stays ? 0 : room * random.nextGaussian() / 3;
                north += stays ? 0 : room * random.nextGaussian() / 3;
                step += random.nextInt(20) == 0 ? random.nextInt(SILENCE) : random.nextInt(8);
            }
        }
        return fixes;
    }

    public List<PositionFix> shuffled(List<PositionFix> fixes, long bound) {
        return shuffled(fixes, bound, random);
    }

    /** An order of arrival in which nothing comes more than the bound behind something later. */
    public static List<PositionFix> shuffled(List<PositionFix> fixes, long bound, Random random) {
        Map<PositionFix, Long> arrivals = new HashMap<>();
        fixes.forEach(fix -> arrivals.put(fix, fix.time() + random.nextLong(bound)));
        List<PositionFix> order = new ArrayList<>(fixes);
        order.sort(Comparator.comparing(arrivals::get));
        return order;
    }

    /** A place so many meters from the center, which around a pole may lie on any meridian. */
    public static double[] place(double[] centre, double east, double north) {
        double perDegree = Geodesy.EARTH_RADIUS_METERS * Math.PI / 180;
        if (Math.abs(centre[0]) == 90) {
            double latitude = centre[0] - Math.signum(centre[0]) * Math.hypot(east, north) / perDegree;
            return new double[] {latitude, Math.toDegrees(Math.atan2(north, east))};
        }
        double longitude = centre[1] + east / perDegree / Math.cos(Math.toRadians(centre[0]));
        return new double[] {centre[0] + north / perDegree, wrapped(longitude)};
    }

    public static double wrapped(double longitude) {
        return longitude > 180 ? longitude - 360 : longitude < -180 ? longitude + 360 : longitude;
    }
}
