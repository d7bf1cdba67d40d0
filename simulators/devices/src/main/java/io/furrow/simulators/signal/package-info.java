/** Readings of sensors at an instant, sound or faulty: pure functions of a seed and a time. */
package io.furrow.simulators.signal;
