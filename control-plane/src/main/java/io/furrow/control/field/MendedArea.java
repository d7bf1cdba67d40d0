package io.furrow.control.field;

import java.util.List;

import org.locationtech.jts.geom.Geometry;

/**
 * An area that can be used.
 *
 * @param area valid Polygon or MultiPolygon, longitude and latitude in WGS 84, within ±180 and ±90
 * @param notes what was mended, in words
 * @param edgeErrorMeters by how much at most an edge, straight in the file, lies elsewhere now that its ends are joined in longitude
 *     and latitude (looked at in the middle of each edge, where it is greatest)
 */
record MendedArea(Geometry area, List<String> notes, double edgeErrorMeters) {}
