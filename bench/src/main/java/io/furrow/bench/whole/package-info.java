/**
 * Measures the cost of the whole suite, beside an older commit: each runs in its own process, alternately, and is measured from outside.
 *
 * <p>In: a checkout and a commit. Out: processor time, memory, threads and delays of both, and their ratios. Must not know: the suite's
 * internals.
 */
package io.furrow.bench.whole;
