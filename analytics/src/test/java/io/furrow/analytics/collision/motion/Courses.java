package io.furrow.analytics.collision.motion;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.Set;

import io.furrow.analytics.Seeds;
import io.furrow.analytics.collision.Worlds;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

/** Made-up machines: some steady on their course, some turning, silent at times, with and without a reported course. */
public final class Courses {
    public static final long START = 1_700_000_000_000L;
    /** Where a turning Earth makes trouble, and one place where it does not: latitude and longitude. */
    public static final double[][] CENTRES = {
        {40.3125, -3.4821}, {0, 0}, {52.1, 180}, {90, 0}, {-90, 0}, {0.00001, -180}
    };

    private static final long LENGTH = 20_000;

    private final Random random;

    public Courses(long seed) {
        random = Seeds.random(seed);
    }

    /** 5 m, time-to-live 4 s, horizon 6 s, both kinds, at most 30 m/s, a record a second. */
    public static MotionRules rules(double cellMeters) {
        CollisionRules common = new CollisionRules(
                5, Duration.ofSeconds(4), Duration.ZERO, Duration.ofSeconds(1), Math.max(5, cellMeters));
        return new MotionRules(common, Duration.ofSeconds(6), true, 30, Set.of());
    }

    public static PositionFix fix(String device, double[] place, double speed, double heading, long time) {
        return new PositionFix(
                "data.raw", "farm|/|" + device, device, "Robot", "m", "", place[0], place[1], speed, heading, time);
    }

    public static PositionFix fix(String device, double[] place, long time) {
        return fix(device, place, Double.NaN, Double.NaN, time);
    }

    /** The positions of one world, from the start on, in no order. */
    public List<PositionFix> world(double[] centre, long start) {
        List<PositionFix> fixes = new ArrayList<>();
        int devices = 2 + random.nextInt(4);
        for (int device = 0; device < devices; device++) {
            boolean tells = random.nextInt(3) == 0;
            String carrier = device > 0 && random.nextInt(6) == 0 ? fixes.get(0).identity() : "";
            double east = 25 * random.nextGaussian();
            double north = 25 * random.nextGaussian();
            double course = 360 * random.nextDouble();
            double speed = random.nextInt(6) == 0 ? 0 : 25 * random.nextDouble();
            long time = start + random.nextInt(1500);
            while (time < start + LENGTH) {
                double[] place = Worlds.place(centre, east, north);
                fixes.add(new PositionFix(
                        "data.raw",
                        "farm|/|" + device,
                        "d" + device,
                        random.nextInt(20) == 0 ? "Tractor" : "Robot",
                        "m",
                        carrier,
                        place[0],
                        place[1],
                        tells ? speed : Double.NaN,
                        tells ? course : Double.NaN,
                        time));
                long step = random.nextInt(25) == 0 ? 1 + random.nextInt(6000) : 300 + 100 * random.nextInt(15);
                course += random.nextInt(4) == 0 ? 120 * random.nextGaussian() : 0;
                east += speed * step / 1000 * Math.sin(Math.toRadians(course));
                north += speed * step / 1000 * Math.cos(Math.toRadians(course));
                course = Math.floorMod((long) course, 360L);
                time += step;
            }
        }
        return fixes;
    }

    public List<PositionFix> shuffled(List<PositionFix> fixes, long bound) {
        return Worlds.shuffled(fixes, bound, random);
    }
}
