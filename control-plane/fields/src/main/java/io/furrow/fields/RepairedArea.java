package io.furrow.fields;

import java.util.List;

import org.locationtech.jts.geom.Geometry;

/**
 * A repaired area.
 *
 * @param area valid Polygon or MultiPolygon, longitude and latitude in WGS 84, within ±180 and ±90
 * @param notes repairs, as text
 * @param edgeErrorMeters maximum deviation of an edge that is straight in the file from the straight edge in longitude
 * and latitude (measured at the middle of each edge, where it is greatest)
 */
record RepairedArea(Geometry area, List<String> notes, double edgeErrorMeters) {}
