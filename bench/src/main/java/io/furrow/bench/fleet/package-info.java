/** Measures the cost of a fleet of simulated devices. */
package io.furrow.bench.fleet;
