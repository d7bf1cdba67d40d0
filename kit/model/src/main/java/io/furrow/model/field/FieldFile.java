package io.furrow.model.field;

import java.util.List;

/**
 * The content of a field file: each feature is either imported as a field or rejected with a reason.
 *
 * @param crs name of the coordinate system that the file is in
 * @param accuracyMeters of the transformation to WGS 84, as specified by EPSG; NaN if unspecified
 * @param notes remarks on the file as a whole
 */
public record FieldFile(
        String crs,
        double accuracyMeters,
        List<ImportedField> fields,
        List<RejectedFeature> refused,
        List<String> notes) {}
