package io.furrow.model.field;

import java.util.List;

/**
 * A feature that became a field.
 *
 * @param number of the feature in the file, from 1
 * @param hectares on the ellipsoid
 * @param notes repairs, as text; empty if none
 * @param edgeErrorMeters maximum deviation of an edge that is straight in the file from the straight edge in longitude and
 *     latitude
 */
public record ImportedField(
        int number, FieldVersion version, double hectares, List<String> notes, double edgeErrorMeters) {}
