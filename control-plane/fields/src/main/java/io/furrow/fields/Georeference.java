package io.furrow.fields;

import java.util.List;
import java.util.logging.Level;
import java.util.logging.Logger;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.geotools.api.referencing.FactoryException;
import org.geotools.api.referencing.crs.CoordinateReferenceSystem;
import org.geotools.api.referencing.crs.GeographicCRS;
import org.geotools.api.referencing.crs.ProjectedCRS;
import org.geotools.api.referencing.operation.CoordinateOperation;
import org.geotools.api.referencing.operation.MathTransform;
import org.geotools.api.referencing.operation.TransformException;
import org.geotools.referencing.CRS;
import org.geotools.referencing.operation.AbstractCoordinateOperation;
import org.geotools.referencing.operation.transform.ConcatenatedTransform;
import org.geotools.referencing.operation.transform.IdentityTransform;
import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.field.InvalidFileException;
import io.furrow.model.text.FailureText;

/**
 * Transforms coordinates to longitude and latitude in WGS 84. The input order is x, y: easting or longitude first,
 * whatever axis order the system defines, because Shapefile, GeoPackage and GeoJSON all use it.
 *
 * @param name of the coordinate system
 * @param accuracyMeters of the datum transformation, as specified by EPSG; NaN if unspecified, 0 if the datum does not
 * change
 */
record Georeference(String name, MathTransform transform, boolean northFirst, double accuracyMeters) {
    /** {@code EPSG:25830}, {@code urn:ogc:def:crs:EPSG::25830}, {@code http://www.opengis.net/def/crs/EPSG/0/25830}. */
    private static final Pattern EPSG = Pattern.compile("(?i)(?:.*[:/])?EPSG(?:[:/][^:/]*)?[:/](\\d+)");

    private static final Pattern CRS84 = Pattern.compile("(?i).*\\bCRS:?84");
    private static final int WGS84 = 4326;

    /** Strong references, because the log manager discards the settings of unreferenced loggers. */
    private static final List<Logger> QUIET = List.of(
            Logger.getLogger("org.geotools"), Logger.getLogger("org.hsqldb"), Logger.getLogger("java.util.prefs"));

    static {
        // The logs of GeoTools are of no use to people who import fields.
        QUIET.forEach(logger -> logger.setLevel(Level.OFF));
    }

    /** @throws InvalidFileException if the text names no coordinate system that can be transformed to WGS 84 */
    static Georeference of(String text) throws InvalidFileException {
        Matcher epsg = EPSG.matcher(text.strip());
        try {
            if (CRS84.matcher(text.strip()).matches()) {
                return new Georeference("WGS 84", IdentityTransform.create(2), false, 0);
            }
            if (epsg.matches()) {
                return ofCode(Integer.parseInt(epsg.group(1)));
            }
            return ofDefinition(text);
        } catch (FactoryException | TransformException | NumberFormatException e) {
            throw new InvalidFileException(
                    "'%s' is not a known coordinate system (%s); specify it with --crs, for instance --crs EPSG:25830"
                            .formatted(Phrases.shortened(text), FailureText.of(e)),
                    e);
        }
    }

    private static Georeference ofCode(int code) throws FactoryException {
        if (code == WGS84) {
            return new Georeference("WGS 84", IdentityTransform.create(2), false, 0);
        }
        CoordinateReferenceSystem crs = horizontal(CRS.decode("EPSG:" + code, true));
        return toWgs84(crs.getName().getCode(), crs);
    }

    /** Returns the horizontal part, which vertical and geocentric systems do not have. */
    private static CoordinateReferenceSystem horizontal(CoordinateReferenceSystem crs) throws FactoryException {
        CoordinateReferenceSystem horizontal = CRS.getHorizontalCRS(crs);
        if (horizontal == null) {
            throw new FactoryException("it has neither longitude and latitude nor easting and northing");
        }
        return horizontal;
    }

    /**
     * Parses well-known text, with or without a code. ESRI's well-known text does not relate its datum to WGS 84,
     * therefore the base geographic system is looked up in the EPSG database.
     */
    private static Georeference ofDefinition(String text) throws FactoryException, TransformException {
        CoordinateReferenceSystem crs = horizontal(CRS.parseWKT(text));
        boolean northFirst = CRS.getAxisOrder(crs) == CRS.AxisOrder.NORTH_EAST;
        if (crs instanceof ProjectedCRS projected) {
            GeographicCRS base = projected.getBaseCRS();
            MathTransform toBase =
                    projected.getConversionFromBase().getMathTransform().inverse();
            Integer identified =
                    CRS.getAxisOrder(base) == CRS.AxisOrder.NORTH_EAST ? null : CRS.lookupEpsgCode(base, true);
            if (identified != null) {
                Georeference fromBase = ofCode(identified);
                return new Georeference(
                        crs.getName().getCode(),
                        ConcatenatedTransform.create(toBase, fromBase.transform()),
                        northFirst,
                        fromBase.accuracyMeters());
            }
        } else {
            Integer identified = CRS.lookupEpsgCode(crs, true);
            if (identified != null) {
                return ofCode(identified);
            }
        }
        Georeference strict = toWgs84(crs.getName().getCode(), crs);
        return new Georeference(strict.name(), strict.transform(), northFirst, strict.accuracyMeters());
    }

    /** Creates a strict transformation, which fails if the relation of the datums is unknown. */
    private static Georeference toWgs84(String name, CoordinateReferenceSystem crs) throws FactoryException {
        CoordinateOperation operation =
                CRS.getCoordinateOperationFactory(false).createOperation(crs, CRS.decode("EPSG:" + WGS84, true));
        return new Georeference(
                name, operation.getMathTransform(), false, AbstractCoordinateOperation.getAccuracy(operation));
    }

    /** @throws RejectedFeatureException if the position is outside of the coordinate system */
    Coordinate toWgs84(Coordinate from) throws RejectedFeatureException {
        double[] position = northFirst ? new double[] {from.y, from.x} : new double[] {from.x, from.y};
        try {
            transform.transform(position, 0, position, 0, 1);
        } catch (TransformException | IllegalArgumentException e) { // the latter for angles of millions of turns
            throw outside(from);
        }
        if (!Double.isFinite(position[0]) || !(Math.abs(position[1]) <= 90)) {
            throw outside(from);
        }
        return new Coordinate(position[0], position[1]);
    }

    private RejectedFeatureException outside(Coordinate from) {
        return new RejectedFeatureException(
                "has the corner %s, %s outside of %s; check the coordinate system and the order of x and y"
                        .formatted(from.x, from.y, name));
    }
}
