/** Compares what analytics found in two replays, or in a replay and live: reads, matches and shows the results. */
package io.furrow.cli.compare;
