package io.furrow.analytics.temperature;

import java.io.Serializable;

import org.locationtech.jts.geom.Geometry;

/**
 * A field of the farm, as it travels with the job.
 *
 * @param domain empty where the field belongs to none
 * @param area a valid Polygon or MultiPolygon, x = longitude, y = latitude, degrees in WGS 84
 */
record Field(String id, String domain, Geometry area) implements Serializable {}
