package io.furrow.model.field;

/**
 * A feature that was rejected.
 *
 * @param number of the feature in the file, from 1
 * @param id empty if it has none
 */
public record RejectedFeature(int number, String id, String reason) {}
