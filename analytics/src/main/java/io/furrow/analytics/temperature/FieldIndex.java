package io.furrow.analytics.temperature;

import java.util.Collection;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.GeometryFactory;
import org.locationtech.jts.geom.Point;
import org.locationtech.jts.geom.prep.PreparedGeometry;
import org.locationtech.jts.geom.prep.PreparedGeometryFactory;
import org.locationtech.jts.index.strtree.STRtree;

import io.furrow.model.ngsi.Position;

/**
 * Tells which fields cover a position; a position on the border, also on that of a hole, is covered.
 *
 * <p>Edges are straight in the plane of longitude and latitude, as RFC 7946 has them. The side of an edge is decided in
 * double-double arithmetic on the coordinates as they are, without tolerance: a position is on the border exactly when its
 * doubles are. Between two corners that are not on one parallel or meridian rounding puts most positions meant to be on the
 * border beside it, by less than a nanometre.
 */
final class FieldIndex {
    private record Indexed(Field field, PreparedGeometry area) {}

    private final GeometryFactory points = new GeometryFactory();
    private final STRtree tree = new STRtree();

    FieldIndex(Collection<Field> fields) {
        for (Field field : fields) {
            tree.insert(
                    field.area().getEnvelopeInternal(),
                    new Indexed(field, PreparedGeometryFactory.prepare(field.area())));
        }
        tree.build();
    }

    /** The fields that cover the position, in no order. */
    List<Field> covering(Position position) {
        Point point = points.createPoint(new Coordinate(position.longitude(), position.latitude()));
        return candidates(point).stream()
                .filter(candidate -> candidate.area().covers(point))
                .map(Indexed::field)
                .toList();
    }

    @SuppressWarnings("unchecked") // the tree is raw; only this class fills it
    private List<Indexed> candidates(Point point) {
        return tree.query(point.getEnvelopeInternal());
    }
}
