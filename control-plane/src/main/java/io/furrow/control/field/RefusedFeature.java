package io.furrow.control.field;

/**
 * A feature that did not become a field.
 *
 * @param number of the feature in the file, from 1
 * @param id empty where it has none
 */
public record RefusedFeature(int number, String id, String reason) {}
