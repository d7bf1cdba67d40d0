package io.furrow.control.field;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * One feature of a file, as it was found.
 *
 * @param number counted from 1 in the order of the file
 * @param id what the format itself calls the feature; null where it has no such thing
 * @param properties as JSON
 * @param outline null where {@code fault} says why there is none
 * @param fault why it cannot become a field; null where nothing stands against it yet
 */
record SourceFeature(int number, String id, ObjectNode properties, Outline outline, String fault) {}
