/** Compares the analytics results of two replays, or of a replay and live: reads, matches and shows them. */
package io.furrow.cli.compare;
