package io.furrow.fields;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * A feature as read from a file.
 *
 * @param number counted from 1 in the order of the file
 * @param id the format's own id of the feature; null if it has none
 * @param properties as JSON
 * @param outline null if {@code fault} says why there is none
 * @param fault why it cannot be imported; null if no fault was found yet
 */
record SourceFeature(int number, String id, ObjectNode properties, Outline outline, String fault) {}
