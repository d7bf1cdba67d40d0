/**
 * Reads fields from files of geographic information systems.
 *
 * <p><b>In</b>: GeoJSON, Shapefiles, GeoPackages, in any coordinate system of the EPSG database.
 *
 * <p><b>Out</b>: versions of fields, a report of repairs and rejections.
 *
 * <p><b>Must not know</b>: who calls it; command line and REST API do.
 */
package io.furrow.fields;
