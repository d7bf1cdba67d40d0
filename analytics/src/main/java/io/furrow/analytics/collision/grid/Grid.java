package io.furrow.analytics.collision.grid;

import java.io.Serializable;
import java.util.Arrays;

import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * A grid of cells over the whole Earth: bands of latitude of equal height, each divided into columns so that cells are
 * roughly square. A position belongs to its home cell and, as a halo copy, to every cell <em>with a greater id</em> that the
 * circle of the threshold around it touches. Of two close positions, the one with the lesser home is therefore also in the
 * home of the other, and both meet in exactly one cell that is home to at least one. This holds on any grid and assumes
 * nothing about neighbors, so that the antimeridian, the poles and unaligned columns are no special cases.
 */
public final class Grid implements Serializable {
    private static final long serialVersionUID = 1L;

    /** Radians (6 µm): a thousand times the rounding of any angle here; a superfluous copy is harmless. */
    private static final double GUARD = 1e-12;

    private static final long SPREAD = 0x9E3779B97F4A7C15L;
    /** The inverse of the multiplier above. */
    private static final long GATHER = 0xF1DE83E19937733DL;

    private static final double POLE = Math.PI / 2;
    private static final double CIRCLE = 2 * Math.PI;

    private final double reach;
    private final int bands;
    private final double height;

    public Grid(CollisionRules rules) {
        double least = rules.cellMeters() / Geodesy.EARTH_RADIUS_METERS;
        reach = rules.thresholdMeters() / Geodesy.EARTH_RADIUS_METERS + GUARD;
        bands = Math.max(1, (int) (Math.PI / least));
        height = Math.PI / bands;
    }

    /** The ids of the home cell, first, and of the cells that need a halo copy; degrees. */
    public long[] cells(double latitude, double longitude) {
        double phi = Math.toRadians(latitude);
        double lambda = Math.toRadians(longitude);
        int homeBand = band(phi);
        int homeColumns = columns(homeBand);
        long home = id(homeBand, Math.floorMod(column(lambda, homeColumns), homeColumns));

        double halfWidth = halfWidth(phi);
        int south = band(phi - reach);
        int north = band(phi + reach);
        if (south == north && column(lambda - halfWidth, homeColumns) == column(lambda + halfWidth, homeColumns)) {
            return new long[] {home};
        }
        long[] cells = new long[8];
        int count = 0;
        cells[count++] = home;
        for (int band = south; band <= north; band++) {
            int columns = columns(band);
            int west = column(lambda - halfWidth, columns);
            int width = Math.min(columns, column(lambda + halfWidth, columns) - west + 1);
            for (int i = 0; i < width; i++) {
                long cell = id(band, Math.floorMod(west + i, columns));
                if (cell > home) {
                    cells = count == cells.length ? Arrays.copyOf(cells, 2 * count) : cells;
                    cells[count++] = cell;
                }
            }
        }
        return Arrays.copyOf(cells, count);
    }

    /** Latitude and longitude of the center of a cell; degrees. */
    public double[] center(long cell) {
        long number = cell * GATHER;
        int band = (int) (number >>> 32);
        int column = (int) number;
        int columns = columns(band);
        return new double[] {
            Math.toDegrees((band + 0.5) * height - POLE), Math.toDegrees((column + 0.5) * CIRCLE / columns - Math.PI)
        };
    }

    /** Half the width of the circle, in radians of longitude: all around if it contains a pole. */
    private double halfWidth(double phi) {
        boolean holdsPole = Math.abs(phi) + reach >= POLE;
        return holdsPole ? CIRCLE : StrictMath.asin(StrictMath.sin(reach) / StrictMath.cos(phi)) + GUARD;
    }

    private int band(double phi) {
        return Math.max(0, Math.min(bands - 1, (int) Math.floor((phi + POLE) / height)));
    }

    /** The largest number of columns that are at least as wide as the band is high, where the band is narrowest. */
    private int columns(int band) {
        double towardsPole = Math.max(Math.abs(band * height - POLE), Math.abs((band + 1) * height - POLE));
        return Math.max(1, (int) (CIRCLE * StrictMath.cos(towardsPole) / height));
    }

    /** The column before wrapping around; ascends with the longitude. */
    private static int column(double lambda, int columns) {
        return (int) Math.floor((lambda + Math.PI) / CIRCLE * columns);
    }

    /** A bijection that spreads the bits, so that neighboring cells fall into different key groups and hash buckets. */
    private static long id(int band, int column) {
        return ((long) band << 32 | column) * SPREAD;
    }
}
