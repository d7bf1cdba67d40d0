package io.furrow.control.field;

import java.util.List;

/**
 * The features of a file.
 *
 * @param crs the coordinate system as the file names it, a code or well-known text; null where it says nothing
 * @param features in the order of the file
 * @param notes what is to be told of the file as a whole
 */
record FieldLayer(String crs, List<SourceFeature> features, List<String> notes) {}
