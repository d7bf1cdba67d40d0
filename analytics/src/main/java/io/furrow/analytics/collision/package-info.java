/**
 * Detects which devices are closer to each other than a threshold, and for how long: exact, in event time, the same at any parallelism,
 * cell size and order of arrival.
 *
 * <p>{@code last(d, t)} is the accepted position of device d with the greatest event time ≤ t; undefined once t has reached that time +
 * time-to-live. A pair is close at t when the great-circle distance of both is ≤ threshold. An encounter lasts from the first instant at
 * which a pair is close to the first at which it no longer is; all changes of one instant apply at once.
 *
 * <p>There are three keyed stages: {@link io.furrow.analytics.collision.grid.TrackDevices} assigns each device to the grid cells that its
 * surroundings touch, {@link io.furrow.analytics.collision.matching.MatchPairs} compares the devices of a cell, and
 * {@link io.furrow.analytics.collision.encounter.TrackEncounters} joins the cells' observations of a pair into encounters.
 *
 * <p>In a crowd, where more devices are close to one than the rules allow, the nearest are followed:
 * {@link io.furrow.analytics.collision.matching.PairSelection}, and docs/adr/0045.
 *
 * <p>After them, if enabled, {@link io.furrow.analytics.collision.debounce.DebounceEncounters} drops encounters that flicker or are short;
 * docs/adr/0018 explains the options.
 */
package io.furrow.analytics.collision;
