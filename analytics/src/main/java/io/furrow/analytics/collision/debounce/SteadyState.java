package io.furrow.analytics.collision.debounce;

import io.furrow.analytics.collision.encounter.Encounter;

/**
 * What is remembered of a pair behind the exact stages while it is close.
 *
 * @param newest the encounter as last seen, whether or not it was emitted
 * @param emitted whether its start was
 * @param reported event time of the newest record about it; without meaning until it was emitted
 */
public record SteadyState(Encounter newest, boolean emitted, long reported) {}
