package io.furrow.analytics.collision.rules;

import java.io.Serializable;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.GeometryFactory;
import org.locationtech.jts.geom.Point;
import org.locationtech.jts.geom.prep.PreparedGeometry;
import org.locationtech.jts.geom.prep.PreparedGeometryFactory;
import org.locationtech.jts.index.strtree.STRtree;

/**
 * Yards and other places where closeness of devices is meaningless: a device inside takes no part. The boundary is
 * inside. Edges are straight in the plane of longitude and latitude, as in RFC 7946.
 */
public final class ExclusionZones implements Serializable {
    /** No zone. */
    public static final ExclusionZones NONE = new ExclusionZones(List.of());

    private static final long serialVersionUID = 1L;
    private static final double ANTIMERIDIAN = 180;

    private final List<Geometry> areas;
    private transient STRtree index;

    /**
     * @param areas valid areas in degrees, x is the longitude
     */
    public ExclusionZones(List<Geometry> areas) {
        this.areas = List.copyOf(areas);
    }

    /** Whether one of them covers a position; degrees. */
    public boolean cover(double latitude, double longitude) {
        if (areas.isEmpty()) {
            return false;
        }
        return covers(latitude, longitude)
                || Math.abs(longitude) == ANTIMERIDIAN && covers(latitude, -longitude); // the same meridian
    }

    private boolean covers(double latitude, double longitude) {
        if (index == null) {
            index = indexed();
        }
        Point point = new GeometryFactory().createPoint(new Coordinate(longitude, latitude));
        for (Object candidate : index.query(point.getEnvelopeInternal())) {
            if (((PreparedGeometry) candidate).covers(point)) {
                return true;
            }
        }
        return false;
    }

    private STRtree indexed() {
        STRtree tree = new STRtree();
        areas.forEach(area -> tree.insert(area.getEnvelopeInternal(), PreparedGeometryFactory.prepare(area)));
        tree.build();
        return tree;
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof ExclusionZones zones && zones.areas.equals(areas);
    }

    @Override
    public int hashCode() {
        return areas.hashCode();
    }

    @Override
    public String toString() {
        return areas.toString();
    }
}
