package io.furrow.analytics.field;

import org.locationtech.jts.geom.Geometry;

/**
 * A field of the farm from a time on.
 *
 * @param validFrom epoch ms
 * @param name for display; empty if it has no name
 * @param domain empty if it belongs to none
 * @param area a valid Polygon or MultiPolygon, x = longitude, y = latitude, degrees in WGS 84
 */
public record Field(String id, long validFrom, String name, String domain, Geometry area) {}
