/**
 * What the whole suite costs, beside an older commit: each runs as a process of its own, in turns, and is measured from outside.
 *
 * <p>In: a checkout and a commit. Out: processor time, memory, threads and delays of both, and their ratios. Must not know: how the suite
 * is put together.
 */
package io.furrow.bench.whole;
