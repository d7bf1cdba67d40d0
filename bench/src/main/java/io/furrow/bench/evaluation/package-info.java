/**
 * Repeats the evaluation of the WeLASER platform: four sweeps of load through the whole suite, and a report of deliveries and delays.
 *
 * <p>In: sweeps, durations. Out: a file of results that grows point by point, a report with plots. Must not know: how a load is sent and
 * read, which is {@code load}.
 */
package io.furrow.bench.evaluation;
