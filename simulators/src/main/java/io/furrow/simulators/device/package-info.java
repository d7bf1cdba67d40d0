/** Simulated thermometers, cameras and robots that report as real ones do: over MQTT and straight to the context broker. */
package io.furrow.simulators.device;
