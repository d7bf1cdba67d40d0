/**
 * Which devices are closer to each other than a threshold, from when to when: exact, in event time, the same at any
 * parallelism, cell size and order of arrival.
 *
 * <p>{@code last(d, t)} is the accepted position of device d with the greatest event time ≤ t, none once t has reached that
 * time + time-to-live. A pair is close at t when the great-circle distance of both is ≤ threshold. An encounter lasts from
 * the first instant at which a pair is close to the first at which it is no more; everything of one instant counts at once.
 *
 * <p>Three keyed stages find it: {@link io.furrow.analytics.collision.grid.TrackDevices} puts each device into the grid cells
 * that its surroundings touch, {@link io.furrow.analytics.collision.matching.MatchPairs} compares the devices of a cell, and {@link
 * io.furrow.analytics.collision.encounter.TrackEncounters} joins what the cells saw of a pair into encounters.
 *
 * <p>In a crowd, where more devices are close to one than the rules say, the nearest are followed: {@link
 * io.furrow.analytics.collision.matching.PairSelection}, and docs/adr/0045.
 *
 * <p>Behind them, where asked for, {@link io.furrow.analytics.collision.debounce.DebounceEncounters} leaves out encounters that flicker or
 * are short; what each option means is in docs/adr/0018.
 */
package io.furrow.analytics.collision;
