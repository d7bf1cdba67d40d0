package io.furrow.analytics.coverage;

import java.nio.ByteBuffer;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.Map;

import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.io.ParseException;
import org.locationtech.jts.io.WKBReader;

/** Caches the grids of the areas last used, up to a number of cells. */
final class GridCache {
    /** 64 MiB. */
    private static final long MAX_CELLS = 1L << 29;

    private static final int CAPACITY = 16;
    private static final float LOAD_FACTOR = 0.75f;

    private final Map<Key, FieldGrid> grids = new LinkedHashMap<>(CAPACITY, LOAD_FACTOR, true);
    private long cells;

    /** The area of a field as WKB, and the requested side of a cell. */
    private record Key(ByteBuffer area, double cell) {}

    /**
     * @param area as WKB
     * @param cell side of a cell, meters
     */
    FieldGrid get(byte[] area, double cell) {
        Key key = new Key(ByteBuffer.wrap(area), cell);
        FieldGrid known = grids.get(key);
        if (known != null) {
            return known;
        }
        FieldGrid grid = FieldGrid.of(parsed(area), cell);
        grids.put(key, grid);
        cells += size(grid);
        Iterator<FieldGrid> eldest = grids.values().iterator();
        while (cells > MAX_CELLS && grids.size() > 1) {
            cells -= size(eldest.next());
            eldest.remove();
        }
        return grid;
    }

    private static long size(FieldGrid grid) {
        return (long) grid.columns() * grid.rows();
    }

    private static Geometry parsed(byte[] area) {
        try {
            return new WKBReader().read(area);
        } catch (ParseException e) {
            throw new IllegalStateException("the area in the state of a coverage is not WKB", e);
        }
    }
}
