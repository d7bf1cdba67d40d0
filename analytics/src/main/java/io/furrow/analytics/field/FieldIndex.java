package io.furrow.analytics.field;

import java.util.ArrayList;
import java.util.Collection;
import java.util.List;

import org.locationtech.jts.algorithm.locate.IndexedPointInAreaLocator;
import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Location;
import org.locationtech.jts.index.strtree.STRtree;

import io.furrow.model.position.Position;

/**
 * Finds the fields that cover a position at a time; a position on the border, also on that of a hole, is covered.
 *
 * <p>Edges are straight in the plane of longitude and latitude, as in RFC 7946. The side of an edge is decided in
 * double-double arithmetic on the exact coordinates, without tolerance: a position is on the border exactly when its
 * doubles are. Between two corners that are not on one parallel or meridian, rounding moves most positions on the border
 * off it, by less than a nanometer.
 */
final class FieldIndex {
    /** A field with an index of its interior, which is built once and outlives rebuilds of the field index. */
    static final class Located {
        private final Field field;
        private final IndexedPointInAreaLocator locator;

        Located(Field field) {
            this.field = field;
            this.locator = new IndexedPointInAreaLocator(field.area());
        }

        Field field() {
            return field;
        }

        private boolean covers(Coordinate point) {
            return locator.locate(point) != Location.EXTERIOR;
        }
    }

    /**
     * A version of a field and its end.
     *
     * @param until epoch ms of the next version, exclusive
     */
    record Interval(Located located, long until) {
        private boolean holdsAt(long time) {
            return located.field.validFrom() <= time && time < until;
        }
    }

    private final STRtree tree = new STRtree();

    FieldIndex(Collection<Interval> spans) {
        for (Interval interval : spans) {
            tree.insert(interval.located().field.area().getEnvelopeInternal(), interval);
        }
        tree.build();
    }

    /** The fields that cover the position at an event time in epoch ms, unordered. */
    List<Field> covering(Position position, long time) {
        Coordinate point = new Coordinate(position.longitude(), position.latitude());
        List<Field> covering = new ArrayList<>();
        tree.query(new Envelope(point), item -> {
            Interval interval = (Interval) item; // the tree is raw; only this class fills it
            if (interval.holdsAt(time) && interval.located.covers(point)) {
                covering.add(interval.located.field);
            }
        });
        return covering;
    }
}
