/** Devices that do nothing but send at a set pace, to measure what the suite carries. */
package io.furrow.simulators.load;
