package io.furrow.bench.analytics.load;

import java.util.function.Consumer;

import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.DeviceInfo;
import io.furrow.analytics.position.PositionFix;

/**
 * Simulates devices that walk at random in a square of 2 km, with a standard deviation of one meter a second, each
 * reporting once per second of event time at its own millisecond. Positions depend on the seed alone.
 */
public final class Fleet {
    public static final long START = 1_700_000_000_000L;
    public static final int TICKS_PER_SECOND = 5;

    /** Default side of the square, in meters. */
    static final double SIDE = 2000;

    public static final double LATITUDE = 40.3125;
    static final double LONGITUDE = -3.4821;
    private static final double METERS_PER_DEGREE = 6_371_000 * Math.PI / 180;
    private static final double METERS_PER_DEGREE_EAST = METERS_PER_DEGREE * Math.cos(Math.toRadians(LATITUDE));
    private static final String TOPIC = "data.raw";
    private static final String SCOPE = "farm|/|";
    private static final long GOLDEN = 0x9E3779B97F4A7C15L;
    private static final double UNIT = 0x1.0p-16;
    /** The sum of four uniform numbers less its mean has a variance of a third. */
    private static final double DEVIATION = Math.sqrt(3);

    private final int devices;
    private final int share;
    private final int shares;
    private final double side;
    private final double[] east;
    private final double[] north;
    private final DeviceInfo[] reporters;

    /** Every {@code shares}-th device from number {@code share} on. */
    public Fleet(int devices, int share, int shares) {
        this(devices, share, shares, SIDE);
    }

    Fleet(int devices, int share, int shares, double side) {
        this.side = side;
        this.devices = devices;
        this.share = share;
        this.shares = shares;
        int mine = (devices - share + shares - 1) / shares;
        east = new double[mine];
        north = new double[mine];
        reporters = new DeviceInfo[mine];
        for (int i = 0; i < mine; i++) {
            int device = share + i * shares;
            east[i] = side * uniform(mixed(device, -1));
            north[i] = side * uniform(mixed(device, -2));
            String id = "urn:ngsi-ld:Robot:" + device;
            reporters[i] = reporter(SCOPE + id, id);
        }
    }

    /** Moves the devices that are due and emits their positions, in order of time. */
    public void tick(long tick, Consumer<PositionFix> out) {
        long second = tick / TICKS_PER_SECOND;
        int part = (int) (tick % TICKS_PER_SECOND);
        int from = atLeast((int) ((long) devices * part / TICKS_PER_SECOND));
        int to = (int) ((long) devices * (part + 1) / TICKS_PER_SECOND);
        for (int device = from; device < to; device += shares) {
            out.accept(move(device, START + second * 1000 + device * 1000L / devices, second));
        }
    }

    /** The first device of this share at or above the given one. */
    private int atLeast(int device) {
        return device + Math.floorMod(share - device, shares);
    }

    private PositionFix move(int device, long time, long second) {
        int i = device / shares;
        east[i] = inside(east[i] + step(mixed(device, 2 * second)));
        north[i] = inside(north[i] + step(mixed(device, 2 * second + 1)));
        return fix(
                reporters[i],
                LATITUDE + north[i] / METERS_PER_DEGREE,
                LONGITUDE + east[i] / METERS_PER_DEGREE_EAST,
                time);
    }

    /** A position at a distance, in meters, from the fleet's origin. */
    public static PositionFix at(String id, double east, double north, long time) {
        double latitude = LATITUDE + north / METERS_PER_DEGREE;
        double degreeEast = METERS_PER_DEGREE * Math.cos(Math.toRadians(latitude));
        return fix(SCOPE + id, id, latitude, LONGITUDE + east / degreeEast, time);
    }

    private static DeviceInfo reporter(String identity, String id) {
        return DeviceInfo.of(new Device(TOPIC, identity), id, "Robot", "", "");
    }

    public static PositionFix fix(String identity, String id, double latitude, double longitude, long time) {
        return fix(reporter(identity, id), latitude, longitude, time);
    }

    private static PositionFix fix(DeviceInfo reporter, double latitude, double longitude, long time) {
        return new PositionFix(reporter, latitude, longitude, Double.NaN, Double.NaN, time);
    }

    /** The number of the device, from 0 on. */
    public static int number(PositionFix fix) {
        return Integer.parseInt(
                fix.id(), fix.id().lastIndexOf(':') + 1, fix.id().length(), 10);
    }

    private double inside(double meters) {
        return meters < 0 ? -meters : meters > side ? 2 * side - meters : meters;
    }

    private static double uniform(long bits) {
        return (bits >>> 11) * 0x1.0p-53;
    }

    private static double step(long bits) {
        long sum = (bits & 0xFFFF) + (bits >>> 16 & 0xFFFF) + (bits >>> 32 & 0xFFFF) + (bits >>> 48);
        return (sum * UNIT - 2) * DEVIATION;
    }

    /** SplitMix64 of the two numbers. */
    private static long mixed(long device, long number) {
        long z = device * 0xD1342543DE82EF95L + (number + 3) * GOLDEN;
        z = (z ^ z >>> 30) * 0xBF58476D1CE4E5B9L;
        z = (z ^ z >>> 27) * 0x94D049BB133111EBL;
        return z ^ z >>> 31;
    }
}
