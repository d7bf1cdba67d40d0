/**
 * The evaluation of the WeLASER platform, repeated: four sweeps of load through the whole suite, and a report of what arrived and when.
 *
 * <p>In: which sweeps, how long. Out: a file of results that grows point by point, a report with plots. Must not know: how a load is sent
 * and read, which is {@code load}.
 */
package io.furrow.bench.evaluation;
