package io.furrow.model.field;

import java.time.Instant;

/**
 * Options for reading a field file.
 *
 * @param layer layer of a GeoPackage; null for its only one
 * @param crs coordinate system, which overrides that of the file; null to use that of the file
 * @param idProperty attribute that contains the fields' ids; null for the feature's own id, else the attribute
 * {@code id}
 * @param nameProperty attribute that contains their names; null for {@code name}
 * @param domain domain of all fields; null for the attribute {@code Domain}
 * @param validFrom event time from which the versions of the file are valid
 */
public record ImportOptions(
        String layer, String crs, String idProperty, String nameProperty, String domain, Instant validFrom) {}
