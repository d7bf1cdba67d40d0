/**
 * Second stage: compares the devices of a cell by thresholds and exclusion zones; in a crowd, follows the nearest ones
 * only.
 */
package io.furrow.analytics.collision.matching;
