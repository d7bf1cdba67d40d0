package io.furrow.analytics.collision;

/**
 * What is remembered of a pair behind the exact stages while it is close.
 *
 * @param newest the encounter as last seen, whether or not it was told
 * @param told whether its start was
 * @param reported event time of the newest record about it; without meaning until it was told
 */
public record Course(Encounter newest, boolean told, long reported) {}
