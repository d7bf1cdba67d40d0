package io.furrow.simulators.robot;

import io.furrow.model.ngsi.Position;
import io.furrow.simulators.signal.Span;

/**
 * Something that lies or stands about for a time.
 *
 * @param radius metres
 */
public record Obstacle(Position place, double radius, Span during) {}
