/** Reads GeoJSON, GeoPackage and shapefiles. */
package io.furrow.fields.file;
