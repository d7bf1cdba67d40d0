package io.furrow.fields;

import java.util.List;

/**
 * The features of a file.
 *
 * @param crs the coordinate system as the file names it, a code or well-known text; null if unspecified
 * @param features in the order of the file
 * @param notes remarks on the file as a whole
 */
record FieldLayer(String crs, List<SourceFeature> features, List<String> notes) {}
