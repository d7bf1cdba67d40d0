package io.furrow.model.position;

/**
 * A position on Earth in WGS 84.
 *
 * @param latitude degrees, −90 to 90
 * @param longitude degrees, −180 to 180
 */
public record Position(double latitude, double longitude) {}
