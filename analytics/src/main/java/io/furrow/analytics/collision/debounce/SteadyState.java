package io.furrow.analytics.collision.debounce;

import io.furrow.analytics.collision.encounter.Encounter;

/**
 * The debouncing state of a pair while it is close.
 *
 * @param newest the encounter as last seen, whether or not it was emitted
 * @param emitted whether its start was emitted
 * @param reported event time of its newest emitted record; undefined before the first
 */
public record SteadyState(Encounter newest, boolean emitted, long reported) {}
