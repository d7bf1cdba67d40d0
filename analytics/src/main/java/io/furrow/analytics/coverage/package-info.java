/**
 * Determines what the implements of robots have covered of each field, in event time, on a grid of square cells. A swath is the
 * rectangle between two consecutive positions of a robot, as wide as its implement, while it works; a cell of the field is covered
 * when a swath contains its center. The result is a pure function of the accepted positions and of the versions of fields that
 * arrived in time.
 */
package io.furrow.analytics.coverage;
