package io.furrow.analytics.collision.motion;

import java.io.Serializable;
import java.util.Arrays;

import io.furrow.flink.record.Epochs;

/**
 * Space divided into cubes. A segment belongs to every cube that the threshold's surroundings of it may touch; an approach of two
 * segments is reported in one cube only, that of the first one's closest point. Both segments belong to that cube, because the other is
 * within the threshold then. Two cubes may share an id; they then act as one, which is harmless.
 */
final class Cubes implements Serializable {
    private static final long serialVersionUID = 1L;

    /** A millimeter: a million times the rounding of a place in space. */
    private static final double GUARD = 1e-3;

    private final double edge;
    private final double reach;

    Cubes(MotionRules rules) {
        edge = rules.cubeMeters();
        reach = rules.common().thresholds().greatest() + GUARD;
    }

    long cube(String topic, CartesianPoint cartesianPoint) {
        return id(topic.hashCode(), index(cartesianPoint.x()), index(cartesianPoint.y()), index(cartesianPoint.z()));
    }

    /** Ids, ascending, each once. */
    long[] touched(MotionSegment segment) {
        double length = segment.velocity().length() * (segment.until() - segment.from());
        int pieces = Math.max(1, (int) Math.ceil(length / edge));
        long from = Epochs.original(segment.from());
        long[] found = new long[8];
        int count = 0;
        for (int piece = 0; piece < pieces; piece++) {
            double step = (double) (segment.until() - segment.from()) / pieces;
            CartesianPoint start = segment.at(from + piece * step);
            CartesianPoint end = segment.at(from + (piece + 1) * step);
            for (long id : around(segment.fix().topic().hashCode(), start, end)) {
                found = count == found.length ? Arrays.copyOf(found, 2 * count) : found;
                found[count++] = id;
            }
        }
        return Arrays.stream(found, 0, count).sorted().distinct().toArray();
    }

    private long[] around(int topic, CartesianPoint a, CartesianPoint b) {
        int west = index(Math.min(a.x(), b.x()) - reach);
        int east = index(Math.max(a.x(), b.x()) + reach);
        int near = index(Math.min(a.y(), b.y()) - reach);
        int far = index(Math.max(a.y(), b.y()) + reach);
        int low = index(Math.min(a.z(), b.z()) - reach);
        int high = index(Math.max(a.z(), b.z()) + reach);
        long[] ids = new long[(east - west + 1) * (far - near + 1) * (high - low + 1)];
        int count = 0;
        for (int x = west; x <= east; x++) {
            for (int y = near; y <= far; y++) {
                for (int z = low; z <= high; z++) {
                    ids[count++] = id(topic, x, y, z);
                }
            }
        }
        return ids;
    }

    private int index(double coordinate) {
        return (int) Math.floor(coordinate / edge);
    }

    private static long id(int topic, int x, int y, int z) {
        return mixed(mixed(mixed(mixed(topic) + x) + y) + z);
    }

    /** The finalizer of SplitMix64 (Steele, Lea, Flood 2014): one to one, every bit depends on every other. */
    private static long mixed(long bits) {
        long mixed = bits + 0x9E3779B97F4A7C15L;
        mixed = (mixed ^ mixed >>> 30) * 0xBF58476D1CE4E5B9L;
        mixed = (mixed ^ mixed >>> 27) * 0x94D049BB133111EBL;
        return mixed ^ mixed >>> 31;
    }
}
