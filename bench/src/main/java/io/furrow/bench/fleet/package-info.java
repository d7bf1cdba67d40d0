/** What a fleet of simulated devices costs. */
package io.furrow.bench.fleet;
