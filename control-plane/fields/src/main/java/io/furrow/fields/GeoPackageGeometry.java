package io.furrow.fields;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.GeometryCollection;
import org.locationtech.jts.geom.LineString;
import org.locationtech.jts.geom.Polygon;
import org.locationtech.jts.io.ParseException;
import org.locationtech.jts.io.WKBReader;

/** Reads the binary geometry of a GeoPackage (OGC 12-128, clause 2.1.3): a header followed by well-known binary. */
final class GeoPackageGeometry {
    private static final int FLAGS = 3;
    private static final int FIXED_HEADER = 8;
    /** Size of the envelope in bytes by its code: none, xy, xyz, xym, xyzm. */
    private static final int[] ENVELOPE = {0, 32, 48, 48, 64};

    private GeoPackageGeometry() {}

    static Outline outline(byte[] blob) throws RejectedFeatureException {
        if (blob == null) {
            throw new RejectedFeatureException("has no geometry");
        }
        if (blob.length < FIXED_HEADER || blob[0] != 'G' || blob[1] != 'P') {
            throw new RejectedFeatureException("has a geometry that is not in GeoPackage format");
        }
        int envelope = (blob[FLAGS] >> 1) & 7;
        if (envelope >= ENVELOPE.length || blob.length < FIXED_HEADER + ENVELOPE[envelope]) {
            throw new RejectedFeatureException("has a geometry with a broken header");
        }
        byte[] wkb = Arrays.copyOfRange(blob, FIXED_HEADER + ENVELOPE[envelope], blob.length);
        Geometry geometry;
        try {
            geometry = new WKBReader().read(wkb);
        } catch (ParseException | IllegalArgumentException e) {
            throw new RejectedFeatureException(
                    "has a geometry that cannot be read (" + e.getMessage() + "); convert curves to lines first");
        }
        List<List<List<Coordinate>>> polygons = new ArrayList<>();
        List<String> notes = new ArrayList<>();
        collect(geometry, polygons, notes);
        int added = geometry.getNumPoints() - corners(wkb, geometry);
        if (added > 0) {
            notes.add(AreaRepair.closed(added));
        }
        return new Outline(polygons, notes);
    }

    private static void collect(Geometry geometry, List<List<List<Coordinate>>> polygons, List<String> notes)
            throws RejectedFeatureException {
        if (geometry instanceof Polygon polygon) {
            if (!polygon.isEmpty()) {
                List<List<Coordinate>> rings = new ArrayList<>();
                rings.add(corners(polygon.getExteriorRing()));
                for (int hole = 0; hole < polygon.getNumInteriorRing(); hole++) {
                    rings.add(corners(polygon.getInteriorRingN(hole)));
                }
                polygons.add(rings);
            }
        } else if (geometry instanceof GeometryCollection some && some.getDimension() >= 2) {
            for (int part = 0; part < some.getNumGeometries(); part++) {
                if (some.getGeometryN(part).getDimension() >= 2) {
                    collect(some.getGeometryN(part), polygons, notes);
                } else {
                    notes.add("left out a " + some.getGeometryN(part).getGeometryType() + " next to the area");
                }
            }
        } else if (!geometry.isEmpty()) {
            throw new RejectedFeatureException(
                    "is a " + geometry.getGeometryType() + "; a field is a Polygon or MultiPolygon");
        }
    }

    private static List<Coordinate> corners(LineString ring) {
        return List.of(ring.getCoordinates());
    }

    /** Returns the number of corners in the bytes; JTS adds further ones to close rings. */
    private static int corners(byte[] wkb, Geometry geometry) {
        int kind = ByteBuffer.wrap(wkb)
                .order(wkb[0] == 0 ? ByteOrder.BIG_ENDIAN : ByteOrder.LITTLE_ENDIAN)
                .getInt(1);
        int ordinates = 2 + ((kind / 1000) % 4 == 0 ? 0 : (kind / 1000) % 4 == 3 ? 2 : 1);
        int polygons = geometry instanceof Polygon ? 1 : geometry.getNumGeometries();
        int heads = geometry instanceof Polygon ? 9 : 9 + 9 * polygons;
        int rings = 0;
        for (int part = 0; part < geometry.getNumGeometries(); part++) {
            if (!(geometry.getGeometryN(part) instanceof Polygon polygon)) {
                return geometry.getNumPoints();
            }
            rings += polygon.isEmpty() ? 0 : 1 + polygon.getNumInteriorRing();
        }
        return (wkb.length - heads - 4 * rings) / (8 * ordinates);
    }
}
