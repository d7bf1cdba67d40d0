/**
 * Reads fields from files of geographic information systems.
 *
 * <p><b>In</b>: GeoJSON, Shapefiles, GeoPackages, in any coordinate system of the EPSG database.
 *
 * <p><b>Out</b>: versions of fields, a report of repairs and rejections.
 *
 * <p><b>Must not know</b>: its callers, command line and REST API.
 */
package io.furrow.fields;
