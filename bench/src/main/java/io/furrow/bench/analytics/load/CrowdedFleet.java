package io.furrow.bench.analytics.load;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Random;
import java.util.function.Consumer;

import io.furrow.analytics.position.PositionFix;

/** A {@link Fleet}, and a kilometer south of it stationary devices on one spot whose receivers have noise. */
public final class CrowdedFleet {
    /** Standard deviation of the noise along each axis, in meters. */
    static final double NOISE = 0.3;

    public static final String CROWD = "urn:ngsi-ld:Parked:";
    private static final double METER = Math.toDegrees(1 / 6_371_000.0);
    private static final double SPOT = Fleet.LATITUDE - 1000 * METER;
    /** The decimals of degrees in reports. */
    private static final double DECIMALS = 1e7;

    private final int crowd;
    private final Fleet fleet;
    private final Random random = new Random(1);

    public CrowdedFleet(int crowd, int others) {
        this.crowd = crowd;
        fleet = new Fleet(others, 0, 1);
    }

    public void tick(long tick, Consumer<PositionFix> out) {
        List<PositionFix> fixes = new ArrayList<>();
        fleet.tick(tick, fixes::add);
        int parts = Fleet.TICKS_PER_SECOND;
        int from = (int) (crowd * (tick % parts) / parts);
        int to = (int) (crowd * (tick % parts + 1) / parts);
        for (int device = from; device < to; device++) {
            long time = Fleet.START + tick / parts * 1000 + device * 1000L / crowd;
            fixes.add(noisy(CROWD + device, SPOT, time, random));
        }
        fixes.sort(Comparator.comparingLong(PositionFix::time));
        fixes.forEach(out);
    }

    /** A noisy position at the spot. */
    public static PositionFix noisy(String id, double latitude, long time, Random random) {
        double east = NOISE * random.nextGaussian() / Math.cos(Math.toRadians(latitude));
        double north = NOISE * random.nextGaussian();
        return Fleet.fix("farm|/|" + id, id, latitude + METER * north, Fleet.LONGITUDE + METER * east, time);
    }

    /** The position rounded as in a report. */
    public static PositionFix rounded(PositionFix fix) {
        return Fleet.fix(fix.identity(), fix.id(), rounded(fix.latitude()), rounded(fix.longitude()), fix.time());
    }

    private static double rounded(double degrees) {
        return Math.round(degrees * DECIMALS) / DECIMALS;
    }
}
