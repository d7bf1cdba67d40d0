package io.furrow.fields;

import java.util.List;

import io.furrow.model.field.FieldVersion;

/**
 * A feature that became a field.
 *
 * @param number of the feature in the file, from 1
 * @param hectares on the ellipsoid
 * @param notes repairs, as text; empty if none
 * @param edgeErrorMeters see {@link MendedArea}
 */
public record ImportedField(
        int number, FieldVersion version, double hectares, List<String> notes, double edgeErrorMeters) {}
