/** Simulates devices that only send at a fixed rate, to measure the suite's capacity. */
package io.furrow.simulators.load;
