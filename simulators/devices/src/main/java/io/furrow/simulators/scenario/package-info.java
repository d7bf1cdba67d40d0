/** Reads the scenario file of a simulated farm: its devices, their places, behavior and faults. */
package io.furrow.simulators.scenario;
