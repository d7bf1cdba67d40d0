package io.furrow.control.field;

import java.time.Instant;

/**
 * How a file of fields is read.
 *
 * @param layer of a GeoPackage; null for its only one
 * @param crs of the coordinates, instead of what the file says; null to follow the file
 * @param idProperty attribute that holds the fields' ids; null for the feature's own id, else the attribute {@code id}
 * @param nameProperty attribute that holds their names; null for {@code name}
 * @param domain that all belong to; null for the attribute {@code Domain}
 * @param validFrom event time from which on they are as the file has them
 */
public record ImportOptions(
        String layer, String crs, String idProperty, String nameProperty, String domain, Instant validFrom) {}
